#include "apps/run/stored_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "apps/results/folder/identity_json.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/scene_difference.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {

RunCheckpoint stored_checkpoint(const std::filesystem::path& folder, const Scene& scene,
                                const SceneIdentity& identity, const NeededPairs& needed) {
  try {
    return read_checkpoint(folder / checkpoint_name, identity.scene, needed);
  } catch (const OtherSceneError& error) {
    throw OtherSceneError(error.what() + changes_since(folder, scene, identity));
  }
}

std::string changes_since(const std::filesystem::path& folder, const Scene& scene,
                          const SceneIdentity& identity) {
  constexpr std::size_t most_shown = 5;
  nlohmann::ordered_json summary;
  try {
    summary = parse_json(whole_file(folder / "summary.json"));
  } catch (const std::runtime_error&) {
    return {};
  }
  if (!summary.is_object() || !summary.contains("scene")) return {};
  std::vector<std::string> keys = scene_differences(summary["scene"], to_json(scene));
  if (summary.contains("identity"))
    for (std::string& file : changed_files(summary["identity"], identity)) keys.push_back(std::move(file));
  if (keys.empty()) return {};
  const std::size_t hidden = keys.size() - std::min(keys.size(), most_shown);
  keys.resize(keys.size() - hidden);
  return fmt::format("; changed: {}{}", fmt::join(keys, ", "),
                     hidden > 0 ? fmt::format(" and {} more", hidden) : "");
}

}  // namespace ashlar

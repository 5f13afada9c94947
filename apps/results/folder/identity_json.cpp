#include "apps/results/folder/identity_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

std::string text_in(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

std::string hexadecimal(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

}  // namespace

Json to_json(const SceneIdentity& identity) {
  Json files = Json::array();
  for (const auto& [kind, file, sha256] : identity.files)
    files.push_back({{"kind", kind}, {"file", file}, {"sha256", sha256}});
  return {{"version", identity.version},
          {"checkpoint_layout", identity.checkpoint_layout},
          {"scene", hexadecimal(identity.scene)},
          {"files", std::move(files)}};
}

std::vector<std::string> changed_files(const Json& was, const SceneIdentity& is) {
  std::vector<std::string> changes;
  if (!was.is_object() || !was.contains("files")) return changes;
  for (const Json& old : was["files"]) {
    for (const SceneFile& file : is.files)
      if (text_in(old, "file") == file.file && text_in(old, "sha256") != file.sha256)
        changes.push_back(fmt::format("{} {} has changed", file.kind, file.file));
  }
  return changes;
}

std::vector<std::string> identity_differences(const Json& was, const SceneIdentity& is) {
  if (!was.is_object()) return {"they are of a version of the program that did not note its files"};
  std::vector<std::string> differences = changed_files(was, is);
  if (differences.empty() && text_in(was, "scene") != hexadecimal(is.scene))
    differences.emplace_back("blocks or keys have changed");
  if (const std::string version = text_in(was, "version"); version != is.version)
    differences.push_back(fmt::format("the program has changed (was {}, is {})", version, is.version));
  if (!was.contains("checkpoint_layout") || was["checkpoint_layout"] != is.checkpoint_layout)
    differences.emplace_back("the program has changed (another layout of checkpoints)");
  return differences;
}

}  // namespace ashlar

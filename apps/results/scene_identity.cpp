#include "apps/results/scene_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/results/program_version.hpp"
#include "apps/results/run_checkpoint.hpp"
#include "apps/scene/file_hash.hpp"
#include "apps/scene/scene_json.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t hash_of(const LoadedScene& loaded, Json json) {
  for (const char* key : {"end_time", "memory_limit"}) json["analysis"].erase(key);
  if (!loaded.scene.stage.empty()) json["stage"].back()["analysis"].erase("end_time");
  json.erase("title");
  std::uint64_t hash = hash_bytes(json.dump());
  for (const Polyhedron& solid : loaded.solids) {
    ByteWriter writer;
    writer(solid.mesh().points, solid.mesh().triangles);
    hash = hash_bytes(writer.take(), hash);
  }
  return hash;
}

/// Every key `file` of a scene is a path; a record has the hash of what was read beside it.
void add_files(const Json& json, const std::filesystem::path& folder, std::vector<SceneFile>& files) {
  if (!json.is_structured()) return;
  if (json.is_object() && json.contains("file") && json["file"].is_string()) {
    const auto name = json["file"].get<std::string>();
    const bool known =
        std::any_of(files.begin(), files.end(), [&](const SceneFile& file) { return file.file == name; });
    if (known) return;
    if (json.contains("sha256"))
      files.push_back({"record", name, json["sha256"].get<std::string>()});
    else
      files.push_back({"mesh", name, sha256_of(folder / name)});
    return;
  }
  for (const Json& value : json) add_files(value, folder, files);
}

std::string text_in(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

std::string hexadecimal(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

}  // namespace

SceneIdentity scene_identity(const LoadedScene& scene) {
  Json json = to_json(scene.scene);
  SceneIdentity identity{program_version(), checkpoint_layout(), 0, {}};
  add_files(json, scene.scene.file.parent_path(), identity.files);
  identity.scene = hash_of(scene, std::move(json));
  return identity;
}

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

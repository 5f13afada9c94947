#include "apps/results/folder/scene_identity.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/results/folder/program_version.hpp"
#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/scene/json/scene_json.hpp"
#include "apps/scene/records/file_hash.hpp"

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

/// Every key `file` of a scene is a path; a record has the hash of the content that was read.
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

}  // namespace

SceneIdentity scene_identity(const LoadedScene& scene) {
  Json json = to_json(scene.scene);
  SceneIdentity identity{program_version(), checkpoint_layout(), 0, {}};
  add_files(json, scene.scene.file.parent_path(), identity.files);
  identity.scene = hash_of(scene, std::move(json));
  return identity;
}

}  // namespace ashlar

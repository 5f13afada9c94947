#include "apps/results/run_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "apps/results/atomic_file.hpp"
#include "apps/scene/scene_json.hpp"

namespace ashlar {

namespace {

constexpr std::string_view magic = "ashlar checkpoint\n";
constexpr std::uint32_t layout_version = 20;

/// What follows the magic line; then comes the payload, and its hash.
struct Header {
  std::uint32_t version = layout_version;
  std::uint64_t scene = 0;
};

}  // namespace

std::uint64_t scene_hash(const LoadedScene& loaded) {
  nlohmann::ordered_json json = to_json(loaded.scene);
  for (const char* key : {"end_time", "memory_limit"}) json["analysis"].erase(key);
  if (!loaded.scene.stage.empty()) json["stage"].back()["analysis"].erase("end_time");
  json.erase("title");
  std::uint64_t hash = hash_bytes(json.dump());
  for (const Polyhedron& solid : loaded.solids) {
    ByteWriter writer;
    writer(solid.mesh().points, solid.mesh().triangles);
    hash = hash_bytes(writer.take(), hash);
  }
  ByteWriter records;
  const SceneAnalysis& analysis = loaded.scene.analysis;
  for (std::size_t n = 0; analysis.gravity_file && n < analysis.gravity_history.size(); ++n)
    records(analysis.gravity_history[n].time, analysis.gravity_history[n].value);
  const auto add_fix = [&](const SceneFix& fix) {
    for (std::size_t n = 0; fix.file && n < fix.history.size(); ++n)
      records(fix.history[n].time, fix.history[n].value);
  };
  const auto add_load = [&](const SceneLoad& load) {
    for (std::size_t n = 0; load.file && n < load.history.size(); ++n)
      records(load.history[n].time, load.history[n].factor);
  };
  for (const SceneBlock& block : loaded.scene.block) {
    for (const SceneFix& fix : block.fix) add_fix(fix);
    for (const SceneLoad& load : block.load) add_load(load);
  }
  for (const SceneStage& stage : loaded.scene.stage) {
    for (std::size_t n = 0; stage.analysis.gravity_file && n < stage.analysis.gravity_history.size(); ++n)
      records(stage.analysis.gravity_history[n].time, stage.analysis.gravity_history[n].value);
    for (const SceneStage::Fix& entry : stage.fix) add_fix(entry.fix);
    for (const SceneStage::Load& entry : stage.load) add_load(entry.load);
  }
  return hash_bytes(records.take(), hash);
}

std::uintmax_t write_checkpoint(const std::filesystem::path& path, std::uint64_t hash,
                                const RunCheckpoint& checkpoint) {
  std::uintmax_t size = 0;
  write_file_atomically(path, Durability::power, [&](OutputFile& file) {
    ByteWriter header;
    header(layout_version, hash);
    file.write(std::string(magic) + header.take());
    std::uint64_t payload_hash = hash_bytes({});
    ByteWriter payload([&](std::string_view bytes) {
      payload_hash = hash_bytes(bytes, payload_hash);
      file.write(bytes);
    });
    write_snapshot(payload, checkpoint.simulation);
    payload(checkpoint.stages, checkpoint.folder, checkpoint.seconds);
    payload.flush();
    ByteWriter end;
    end(payload_hash);
    file.write(end.take());
    size = file.size();
  });
  return size;
}

RunCheckpoint read_checkpoint(const std::filesystem::path& path, std::uint64_t hash) {
  std::ifstream input(path, std::ios::binary);
  if (!input) throw CheckpointError("no checkpoint to resume from, run without --resume first");
  if (std::filesystem::is_directory(path)) throw CheckpointError("not a checkpoint but a folder");
  const std::string bytes{std::istreambuf_iterator<char>(input), {}};
  if (!bytes.starts_with(magic)) throw CheckpointError("not a checkpoint of this program");
  std::string_view left = std::string_view(bytes).substr(magic.size());
  try {
    Header header;
    ByteReader head(left);
    head(header.version, header.scene);
    if (header.version != layout_version) {
      throw CheckpointError(fmt::format(
          "checkpoint of another version of the program (layout {}), layout {} is needed: run with "
          "--force to start anew",
          header.version, layout_version));
    }
    left.remove_prefix(sizeof header.version + sizeof header.scene);
    std::uint64_t payload_hash = 0;
    const std::size_t size = left.size() - std::min(left.size(), sizeof payload_hash);
    ByteReader tail(left.substr(size));
    tail(payload_hash);
    if (hash_bytes(left.substr(0, size)) != payload_hash)
      throw CheckpointError("checkpoint is damaged, run with --force to start anew");
    if (header.scene != hash) {
      throw OtherSceneError(
          "checkpoint of another scene, the scene, mesh files and --set options the run was started with are "
          "needed; only analysis.end_time may differ");
    }
    ByteReader reader(left.substr(0, size));
    RunCheckpoint checkpoint;
    checkpoint.simulation = read_snapshot(reader);
    reader(checkpoint.stages, checkpoint.folder, checkpoint.seconds);
    return checkpoint;
  } catch (const CheckpointError&) {
    throw;
  } catch (const std::exception& error) {
    throw CheckpointError(
        fmt::format("checkpoint is damaged ({}), run with --force to start anew", error.what()));
  }
}

}  // namespace ashlar

#include "apps/results/folder/run_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "apps/results/folder/stored_layout.hpp"
#include "apps/results/text/atomic_file.hpp"

namespace ashlar {
namespace {

constexpr std::string_view magic = "ashlar checkpoint\n";
/// To be increased if stored values change their meaning but not their layout.
constexpr std::uint64_t meaning_version = 1;

/// Follows the magic line; precedes the payload and its hash.
struct Header {
  std::uint32_t layout = checkpoint_layout();
  std::uint64_t scene = 0;
};

}  // namespace

std::uint32_t checkpoint_layout() {
  static const auto layout = static_cast<std::uint32_t>(stored_layout<RunCheckpoint>(meaning_version));
  return layout;
}

std::uintmax_t write_checkpoint(const std::filesystem::path& path, std::uint64_t hash,
                                const RunCheckpoint& checkpoint) {
  std::uintmax_t size = 0;
  write_file_atomically(path, Durability::power, [&](OutputFile& file) {
    ByteWriter header;
    header(checkpoint_layout(), hash);
    file.write(std::string(magic) + header.take());
    std::uint64_t payload_hash = hash_bytes({});
    ByteWriter payload([&](std::string_view bytes) {
      payload_hash = hash_bytes(bytes, payload_hash);
      file.write(bytes);
    });
    payload(checkpoint);
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
    head(header.layout, header.scene);
    if (header.layout != checkpoint_layout()) {
      throw CheckpointError(fmt::format(
          "checkpoint of another version of the program (layout {}), layout {} is needed: run with "
          "--force to start anew",
          header.layout, checkpoint_layout()));
    }
    left.remove_prefix(sizeof header.layout + sizeof header.scene);
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
    reader(checkpoint);
    return checkpoint;
  } catch (const CheckpointError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw CheckpointError(
        fmt::format("checkpoint is damaged ({}), run with --force to start anew", error.what()));
  }
}

}  // namespace ashlar

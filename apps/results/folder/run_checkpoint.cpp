#include "apps/results/folder/run_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/results/folder/stored_layout.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "solver/struct_members.hpp"

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

/// Writes a checkpoint as a ByteWriter does, with the pairs of a run in place of its own.
class WriterOfRun {
 public:
  WriterOfRun(ByteWriter& writer, PairsOfRun& pairs) : writer_(writer), pairs_(pairs) {}

  void write(const RunCheckpoint& checkpoint) {
    with_members(checkpoint, [this](const SimulationSnapshot& simulation, const auto&... of_run) {
      with_members(simulation, [this](const RunState& state, const auto&... of_simulation) {
        with_members(state, [this](const auto&... members) { (this->write_member(members), ...); });
        writer_(of_simulation...);
      });
      writer_(of_run...);
    });
  }

 private:
  template <class Member>
  void write_member(const Member& member) {
    const auto begin = [this](std::size_t count) { writer_(static_cast<std::uint64_t>(count)); };
    if constexpr (std::is_same_v<Member, PairHistories>) {
      pairs_.visit_histories(
          begin, [this](const PairKey& blocks, const PairHistory& history) { writer_(blocks, history); });
    } else if constexpr (std::is_same_v<Member, std::vector<PairRecord>>) {
      pairs_.visit_records(begin, [this](const PairRecord& record) { writer_(record); });
    } else {
      writer_(member);
    }
  }

  ByteWriter& writer_;
  PairsOfRun& pairs_;
};

/// Reads a checkpoint as a ByteReader does, but keeps only some of its pairs.
class ReaderOfPairs {
 public:
  ReaderOfPairs(ByteReader& reader, const NeededPairs& needed) : reader_(reader), needed_(needed) {}

  void read(RunCheckpoint& checkpoint) {
    with_members(checkpoint, [this](SimulationSnapshot& simulation, auto&... of_run) {
      with_members(simulation, [this](RunState& state, auto&... of_simulation) {
        with_members(state, [this](auto&... members) { (this->read_member(members), ...); });
        reader_(of_simulation...);
      });
      reader_(of_run...);
    });
  }

 private:
  template <class Member>
  void read_member(Member& member) {
    std::uint64_t count = 0;
    if constexpr (std::is_same_v<Member, PairHistories>) {
      for (reader_(count); count > 0; --count) {
        PairKey blocks;
        PairHistory history;
        reader_(blocks, history);
        if (needed_(blocks))
          member.emplace_hint(member.end(), blocks, std::move(history));
        else if (history.overlap > 0.0)
          member[blocks].overlap = history.overlap;
      }
    } else if constexpr (std::is_same_v<Member, std::vector<PairRecord>>) {
      for (reader_(count); count > 0; --count) {
        PairRecord record{};
        reader_(record);
        if (needed_({record.a, record.b})) member.push_back(std::move(record));
      }
    } else {
      reader_(member);
    }
  }

  ByteReader& reader_;
  const NeededPairs& needed_;
};

std::uintmax_t write_file(const std::filesystem::path& path, std::uint64_t hash,
                          const RunCheckpoint& checkpoint, PairsOfRun* pairs) {
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
    if (pairs != nullptr)
      WriterOfRun(payload, *pairs).write(checkpoint);
    else
      payload(checkpoint);
    payload.flush();
    ByteWriter end;
    end(payload_hash);
    file.write(end.take());
    size = file.size();
  });
  return size;
}

}  // namespace

std::uint32_t checkpoint_layout() {
  static const auto layout = static_cast<std::uint32_t>(stored_layout<RunCheckpoint>(meaning_version));
  return layout;
}

std::uintmax_t write_checkpoint(const std::filesystem::path& path, std::uint64_t hash,
                                const RunCheckpoint& checkpoint, PairsOfRun* pairs) {
  try {
    return write_file(path, hash, checkpoint, pairs);
  } catch (...) {
    if (pairs != nullptr) pairs->finish();
    throw;
  }
}

RunCheckpoint read_checkpoint(const std::filesystem::path& path, std::uint64_t hash,
                              const NeededPairs& needed) {
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
    if (needed)
      ReaderOfPairs(reader, needed).read(checkpoint);
    else
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

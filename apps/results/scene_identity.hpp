// Identity of a run's input: the one answer that a summary states, a sweep compares and a checkpoint is bound to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/scene/scene_loading.hpp"

namespace ashlar {

/// A file that a scene names, as it was when the scene was read.
struct SceneFile {
  std::string kind;    ///< "mesh" or "record"
  std::string file;    ///< as the scene names it
  std::string sha256;  ///< of its bytes (file_hash.hpp)
};

struct SceneIdentity {
  std::string version;                  ///< of the program
  std::uint32_t checkpoint_layout = 0;  ///< see run_checkpoint.hpp
  /// Of the scene as used: every key with defaults and overrides, what it includes, SHA-256 of records, points and
  /// triangles of every block. Left out are analysis.end_time, and that of the last stage, as a run may go on beyond its
  /// end, and what no result depends on: title, analysis.memory_limit.
  std::uint64_t scene = 0;
  std::vector<SceneFile> files;  ///< each once, in the order of the scene
};

/// @param scene the whole one, just read: its files are read again for their hashes
[[nodiscard]] SceneIdentity scene_identity(const LoadedScene& scene);

}  // namespace ashlar

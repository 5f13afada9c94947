// Identity of a run's input: stated in a summary, compared by a sweep and required by a checkpoint.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar {

/// A file named by a scene, at the time when the scene was read.
struct SceneFile {
  std::string kind;    ///< "mesh" or "record"
  std::string file;    ///< as the scene names it
  std::string sha256;  ///< of its bytes (file_hash.hpp)
};

struct SceneIdentity {
  std::string version;                  ///< of the program
  std::uint32_t checkpoint_layout = 0;  ///< see run_checkpoint.hpp
  /// Hash of the scene as used: every key with defaults and overrides, included files, SHA-256 of records, points and
  /// triangles of every block. Excluded are analysis.end_time, and that of the last stage, as a run may continue
  /// beyond its end, and keys without influence on results: title, analysis.memory_limit.
  std::uint64_t scene = 0;
  std::vector<SceneFile> files;  ///< each once, in the order of the scene
};

/// @param scene the whole one, just read: its files are read again for their hashes
[[nodiscard]] SceneIdentity scene_identity(const LoadedScene& scene);

}  // namespace ashlar

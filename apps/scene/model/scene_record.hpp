// A file with a history of a scene (scene.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ashlar {

/// { file, time, values, scale } in place of the rows of a history.
struct SceneRecord {
  std::filesystem::path file;  ///< CSV, as written; relative paths are relative to the scene file's folder
  std::string time;            ///< name of the column of times
  std::vector<std::string> values;  ///< names of the columns of values; an empty one: zero
  double scale = 1.0;               ///< of the values
  bool in_order = true;             ///< times must increase from row to row
  std::string sha256;               ///< of the file when it was read
};

}  // namespace ashlar

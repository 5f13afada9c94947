// A file with a history of a scene (scene.hpp).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ashlar {

/// m/s^2, of scale = "g".
inline constexpr double standard_gravity = 9.80665;

/// { file, time, values, scale, baseline, resample } in place of the rows of a history.
struct SceneRecord {
  std::filesystem::path file;        ///< as written; relative paths are relative to the scene file's folder
  std::string time;                  ///< name of the column of times; empty: files without column names
  std::vector<std::string> values;   ///< names of the columns of values; an empty one: zero
  double scale = 1.0;                ///< of the values
  std::string sha256;                ///< of the file when it was read
  bool in_order = true;              ///< times must increase from row to row
  std::optional<int> baseline = {};  ///< order of the polynomial that is removed; empty: none
  std::optional<double> resample = {};  ///< s, interval of rows; empty: those of the file
};

}  // namespace ashlar

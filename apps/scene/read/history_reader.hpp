// Histories of a scene: rows in the scene, or a table with a file and the names of its columns.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar {

/// Rows that begin with a time, which increases from row to row.
struct HistoryRows {
  std::vector<std::vector<double>> rows;
  std::optional<SceneRecord> file;  ///< their file, if not in the scene
};

/// @param width numbers in a row. @param words name of a row, "[t, factor]". @return empty if absent or faulty
[[nodiscard]] std::optional<HistoryRows> read_history(TomlTableReader& table, std::string_view key,
                                                      std::size_t width, const char* words);

}  // namespace ashlar

// Histories of a scene: rows written in it, or a table that names the file and the columns they are in.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "apps/scene/scene.hpp"
#include "apps/scene/toml_table_reader.hpp"

namespace ashlar {

/// Rows that begin with a time, which increases from row to row.
struct HistoryRows {
  std::vector<std::vector<double>> rows;
  std::optional<SceneRecord> file;  ///< where they come from, if not from the scene
};

/// @param width numbers in a row. @param words for a row, "[t, factor]". @return nothing if absent or faulty
[[nodiscard]] std::optional<HistoryRows> read_history(TomlTableReader& table, std::string_view key,
                                                      std::size_t width, const char* words);

}  // namespace ashlar

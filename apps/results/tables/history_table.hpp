// Reads history.csv back.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ashlar {

/// Rows of history.csv.
struct HistoryTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< (#rows x #columns)
};

/// Reads the table; of a longer one an even selection of at most `most_rows` rows and the last one. Columns of earlier versions get their present names. A last line
/// without line break, which a killed run may leave, is ignored.
/// @throws std::runtime_error "cannot read <path>: <reason>", with the line of an invalid row.
[[nodiscard]] HistoryTable read_history(const std::filesystem::path& path, std::size_t most_rows);

}  // namespace ashlar

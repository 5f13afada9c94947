// The table of a sweep: a row per run, with the values of its keys and its results.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/program/sweep/variants.hpp"

namespace ashlar {

/// Results of a sweep. Text columns: the keys, `folder` (beside the table), `status`; then numbers, empty if a run
/// has no such value.
struct SweepTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< fields as in the file, text quoted
};

/// Reads the result folders.
/// @param folders of the variants; the status is "refused" without summary
/// @param values columns of numbers: a path into summary.json ("deepest.value", "factor_of_safety.lower"), or a
/// column of history.csv, with its last value. Empty: `time`, factors if there are any, and final values of measures
/// @throws std::runtime_error with path and reason if results are damaged
[[nodiscard]] SweepTable sweep_table(const std::vector<VariedKey>& keys, const std::vector<Variant>& variants,
                                     const std::vector<std::filesystem::path>& folders,
                                     const std::vector<std::string>& values);

/// The index of the column of a key or a value. @return empty if there is none of that name
[[nodiscard]] std::optional<std::size_t> column_of(const SweepTable& table, const std::string& name);

/// As CSV, with a line of columns first.
[[nodiscard]] std::string table_csv(const SweepTable& table);

}  // namespace ashlar

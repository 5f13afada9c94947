// The run as a table: history.csv with one row for each accepted step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "apps/results/system/output_file.hpp"

namespace ashlar {

/// Writes a comma-separated table whose first column is the step, increasing from row to row. Each row is passed to
/// the system as a whole before append() returns, so that an interrupted, failed or killed run keeps all complete
/// rows and no partial one.
class HistoryWriter {
 public:
  /// Starts a new table; an existing file is emptied. @param columns names, the first being that of the step.
  /// @throws std::invalid_argument without columns; std::runtime_error with path and reason, here and below.
  HistoryWriter(const std::filesystem::path& path, std::span<const std::string> columns);

  /// Continues the table of an interrupted run: rows after `last_step`, and a truncated last line, are removed.
  /// @throws std::runtime_error if the file is missing, has other columns, or does not reach `last_step` (a
  /// table without rows is accepted for step 0).
  [[nodiscard]] static HistoryWriter resume(const std::filesystem::path& path,
                                            std::span<const std::string> columns, std::int64_t last_step);

  /// @param values of the columns after the first. @throws std::invalid_argument if their number is wrong.
  void append(std::int64_t step, std::span<const double> values);

  /// @throws std::runtime_error if the file no longer exists, or was changed by others
  void check_in_place() const { file_.check_in_place(); }
  /// Waits until all rows are on the disk, as a checkpoint relies on them.
  void sync() { file_.sync(); }

 private:
  HistoryWriter(OutputFile file, std::size_t column_count);

  OutputFile file_;
  std::size_t column_count_;
  std::string row_;
};

}  // namespace ashlar

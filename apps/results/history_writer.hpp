// The run as a table: history.csv with one row for each accepted step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "apps/results/output_file.hpp"

namespace ashlar {

/// Writes a comma-separated table whose first column is the step, increasing from row to row. Every row is
/// handed to the system as a whole before append() returns, so an interrupted, failed or killed run keeps all
/// rows and never half a one.
class HistoryWriter {
 public:
  /// Starts a new table; an old file is emptied. @param columns names, the first being that of the step.
  /// @throws std::invalid_argument without columns; std::runtime_error with path and reason, here and below.
  HistoryWriter(const std::filesystem::path& path, std::span<const std::string> columns);

  /// Goes on with the table of an interrupted run: rows after `last_step`, and a last line that was cut, are
  /// dropped.
  /// @throws std::runtime_error if the file is missing, has other columns, or does not reach `last_step` (a
  /// table without rows is accepted for step 0).
  [[nodiscard]] static HistoryWriter resume(const std::filesystem::path& path,
                                            std::span<const std::string> columns, std::int64_t last_step);

  /// @param values of the columns after the first. @throws std::invalid_argument if their number is wrong.
  void append(std::int64_t step, std::span<const double> values);

  /// @throws std::runtime_error if the file is not there any more, or was changed by others
  void check_in_place() const { file_.check_in_place(); }
  /// Waits until all rows are on the disk; before a checkpoint that counts on them.
  void sync() { file_.sync(); }

 private:
  HistoryWriter(OutputFile file, std::size_t column_count);

  OutputFile file_;
  std::size_t column_count_;
  std::string row_;
};

}  // namespace ashlar

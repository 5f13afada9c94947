// Common parts of studies: a table that is printed and written as CSV, a picture, and findings.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "apps/program/plot/plot.hpp"

namespace ashlar {

/// Error of a run that ended early.
inline constexpr double failed_run = std::numeric_limits<double>::quiet_NaN();

/// Result of a study.
struct StudyResult {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< (#rows, #columns)
  Plot plot;
  std::vector<std::string> findings;  ///< sentences
  bool holds = true;                  ///< false if a finding violates a requirement
};

/// Receives a line for each measured value of a long study, as soon as it is known.
using StudyProgress = std::function<void(const std::string& line)>;

/// A study of the program; each is one file, x_study.{hpp,cpp}, and one line in a list.
struct Study {
  const char* name;
  const char* description;
  StudyResult (*run)(const StudyProgress& progress);
};

/// A study that ends soon and shows no progress.
template <StudyResult (*Run)()>
StudyResult without_progress(const StudyProgress&) {
  return Run();
}

/// The table as CSV.
[[nodiscard]] std::string table_csv(const StudyResult& result);
/// The table as text, columns aligned, numbers with four digits.
[[nodiscard]] std::string table_text(const StudyResult& result);

}  // namespace ashlar

#include "apps/program/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/results/text/csv_text.hpp"

namespace ashlar {

std::string table_csv(const StudyResult& result) {
  std::string text;
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    if (c > 0) text += ',';
    text += quote_csv_field(result.columns[c]);
  }
  text += '\n';
  for (const auto& row : result.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) text += ',';
      append_csv_number(text, row[c]);
    }
    text += '\n';
  }
  return text;
}

std::string table_text(const StudyResult& result) {
  const auto cell = [](double value) {
    const bool whole = value == std::floor(value) && std::abs(value) < 1e7;
    return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
  };
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    widths.push_back(result.columns[c].size());
    for (const auto& row : result.rows) widths[c] = std::max(widths[c], cell(row[c]).size());
  }
  std::string text;
  for (std::size_t c = 0; c < widths.size(); ++c)
    text += fmt::format("{:>{}}  ", result.columns[c], widths[c]);
  text += '\n';
  for (const auto& row : result.rows) {
    for (std::size_t c = 0; c < widths.size(); ++c) text += fmt::format("{:>{}}  ", cell(row[c]), widths[c]);
    text += '\n';
  }
  return text;
}

}  // namespace ashlar

#include "apps/results/tables/history_table.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "apps/results/columns/history_columns.hpp"
#include "apps/results/tables/thinned_series.hpp"
#include "apps/results/text/csv_text.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), what));
}

std::size_t count_rows(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  input.exceptions(std::ios::badbit);  // a failed allocation is not the end of the file
  std::size_t lines = 0;
  for (std::string line; std::getline(input, line) && !input.eof();) ++lines;
  return lines == 0 ? 0 : lines - 1;
}

std::vector<double> parse_row(std::string_view line, std::size_t columns) {
  std::vector<double> values;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (values.size() < columns) {
    double value = 0.0;
    const auto [next, error] = parse_number(at, end, value);
    if (error != std::errc{}) break;
    values.push_back(value);
    if (next == end) return values;
    if (*next != ',') break;
    at = next + 1;
  }
  return {};
}

}  // namespace

HistoryTable read_history(const std::filesystem::path& path, std::size_t most_rows) {
  naming_the_file(path, [&] { require_regular_file(path); });
  const std::size_t count = count_rows(path);
  std::ifstream input(path, std::ios::binary);
  input.exceptions(std::ios::badbit);  // a failed allocation is not the end of the file
  std::string line;
  if (!std::getline(input, line)) fail(path, "it cannot be opened or is empty");
  HistoryTable table;
  for (const std::string& field : split_csv_line(line))
    table.columns.push_back(present_name(unmarked_csv_field(field)));
  ThinnedSeries<std::vector<double>> rows(most_rows, {count == 0 ? 0 : count - 1});
  for (std::size_t row = 0; row < count && std::getline(input, line); ++row) {
    if (!rows.wants(row)) continue;
    std::vector<double> values = parse_row(line, table.columns.size());
    if (values.size() != table.columns.size()) {
      fail(path, fmt::format("line {} has not the {} numbers of a row", row + 2, table.columns.size()));
    }
    rows.add(row, std::move(values), 1);
  }
  for (const auto& item : rows.items()) table.rows.push_back(item.value);
  return table;
}

}  // namespace ashlar

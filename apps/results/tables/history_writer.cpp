#include "apps/results/tables/history_writer.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "apps/results/text/csv_text.hpp"

namespace ashlar {
namespace {

std::string header_line(std::span<const std::string> columns) {
  if (columns.empty()) throw std::invalid_argument("a history needs at least the column of the step");
  std::string line;
  for (const std::string& column : columns) {
    if (!line.empty()) line += ',';
    line += quote_csv_field(column);
  }
  return line + '\n';
}

std::int64_t step_of(std::string_view row, const std::filesystem::path& path) {
  std::int64_t step = 0;
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), step);
  if (error != std::errc{} || (end != row.data() + row.size() && *end != ',')) {
    throw std::runtime_error(
        fmt::format("cannot resume {}: no step number at the start of the row '{}'", path.string(), row));
  }
  return step;
}

}  // namespace

HistoryWriter::HistoryWriter(OutputFile file, std::size_t column_count)
    : file_(std::move(file)), column_count_(column_count) {}

HistoryWriter::HistoryWriter(const std::filesystem::path& path, std::span<const std::string> columns)
    : HistoryWriter(OutputFile(path, OutputFile::Start::empty), columns.size()) {
  file_.write(header_line(columns));
}

HistoryWriter HistoryWriter::resume(const std::filesystem::path& path, std::span<const std::string> columns,
                                    std::int64_t last_step) {
  const std::string header = header_line(columns);
  OutputFile file(path, OutputFile::Start::at_end);
  std::ifstream input(path, std::ios::binary);
  input.exceptions(std::ios::badbit);  // a failed allocation is not the end of the file
  std::string start(header.size(), '\0');
  if (!input.read(start.data(), static_cast<std::streamsize>(start.size())) || start != header) {
    throw std::runtime_error("cannot resume " + path.string() + ": its columns are not those of this scene");
  }
  std::uintmax_t kept = header.size();
  std::int64_t step = 0;
  // A last line without line break was truncated while it was written.
  for (std::string row; std::getline(input, row) && !input.eof(); kept += row.size() + 1) {
    const std::int64_t row_step = step_of(row, path);
    if (row_step > last_step) break;
    step = row_step;
  }
  if (step != last_step) {
    throw std::runtime_error(fmt::format("cannot resume {}: its rows end at step {}, before step {}",
                                         path.string(), step, last_step));
  }
  file.truncate(kept);
  return {std::move(file), columns.size()};
}

void HistoryWriter::append(std::int64_t step, std::span<const double> values) {
  if (values.size() + 1 != column_count_) {
    throw std::invalid_argument(
        fmt::format("a history row of {} values, {} needed", values.size() + 1, column_count_));
  }
  row_ = std::to_string(step);
  for (const double value : values) {
    row_ += ',';
    append_csv_number(row_, value);
  }
  row_ += '\n';
  file_.write(row_);
}

}  // namespace ashlar

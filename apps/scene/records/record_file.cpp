#include "apps/scene/records/record_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/records/peer_record.hpp"
#include "apps/scene/records/sampled_record.hpp"
#include "apps/scene/records/text_fields.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "geometry/text/reading_folder.hpp"

namespace ashlar {
namespace {

constexpr std::size_t listed_faults = 20;

bool are_numbers(const std::vector<TextField>& fields) {
  return std::all_of(fields.begin(), fields.end(),
                     [](const TextField& field) { return number_of(field.text); });
}

/// Reads one file and counts its faults.
class RecordReader {
 public:
  RecordReader(const SceneRecord& record, std::string name, Diagnostics& diagnostics)
      : record_(record), name_(std::move(name)), diagnostics_(diagnostics) {}

  std::optional<std::vector<std::vector<double>>> read(std::istream& stream) {
    // A failed allocation for a line must not be mistaken for the end of the file.
    stream.exceptions(std::ios::badbit);
    std::string line;
    std::vector<std::vector<double>> rows;
    while (std::getline(stream, line)) {
      ++line_;
      std::string_view text = line;
      if (line_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
      const std::string_view content = trimmed_text(text);
      if (line_ == 1 && begins_peer_record(content))
        return parse_peer_record(record_, stream, name_, diagnostics_);
      if (const std::size_t ended = content.find('\r'); ended != std::string_view::npos) {
        fault(
            static_cast<int>(content.data() - line.data() + static_cast<std::ptrdiff_t>(ended)) + 1,
            "lines are ended by carriage returns alone (byte 13), line feeds, or both together, are needed");
        return std::nullopt;
      }
      if (content.empty() || content.front() == '#') continue;
      if (columns_.empty()) {
        if (!find_columns(text)) return std::nullopt;
        if (without_names_) add_row(text, rows);
      } else {
        add_row(text, rows);
      }
    }
    if (columns_.empty())
      fault(1, fmt::format("record is empty (no line of column names), {} are needed", wanted()));
    else if (rows.empty() && faults_ == 0)
      fault(1, "record has no rows (0), at least 1 is needed");
    if (faults_ > listed_faults)
      diagnostics_.error(
          {name_, line_, 1},
          fmt::format("record has {} faults in all, the first {} are listed", faults_, listed_faults));
    if (faults_ > 0) return std::nullopt;
    return rows;
  }

 private:
  void fault(int column, std::string message) {
    if (++faults_ <= listed_faults)
      diagnostics_.error({name_, line_ == 0 ? 1 : line_, column}, std::move(message));
  }

  [[nodiscard]] std::string wanted() const {
    std::vector<std::string> names = {record_.time};
    std::copy_if(record_.values.begin(), record_.values.end(), std::back_inserter(names),
                 [](const std::string& name) { return !name.empty(); });
    return fmt::format("columns \"{}\"", fmt::join(names, "\", \""));
  }

  bool find_columns(std::string_view line) {
    separator_ = separator_of(line);
    const std::vector<TextField> fields = fields_of(line, separator_);
    width_ = fields.size();
    std::vector<std::string> names;
    names.reserve(fields.size());
    for (const TextField& field : fields) names.emplace_back(field.text);
    const bool names_time = std::find(names.begin(), names.end(), record_.time) != names.end();
    if (!names_time && are_numbers(fields)) return number_columns();
    if (record_.time.empty()) {
      fault(1, fmt::format(
                   "record has a line of column names ({}); time, the name of its column of times, is needed",
                   fmt::join(names, ", ")));
      return false;
    }
    const auto find = [&](const std::string& name) {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) {
        fault(1, fmt::format("record has no column \"{}\" ({}), {} are needed", name, fmt::join(names, ", "),
                             wanted()));
        return no_column;
      }
      if (const auto times = std::count(names.begin(), names.end(), name); times > 1)
        fault(1, fmt::format("record has several columns \"{}\" ({}), one is needed", name, times));
      return static_cast<std::size_t>(found - names.begin());
    };
    columns_.push_back(find(record_.time));
    for (const std::string& name : record_.values) columns_.push_back(name.empty() ? no_column : find(name));
    return faults_ == 0;
  }

  /// Columns of a file without names: times and values, or columns named by their numbers.
  bool number_columns() {
    without_names_ = true;
    const auto find = [&](const std::string& name, std::size_t other) {
      std::size_t column = 0;
      const auto [stop, status] = std::from_chars(name.data(), name.data() + name.size(), column);
      const bool whole = !name.empty() && status == std::errc() && stop == name.data() + name.size();
      if (whole && column >= 1 && column <= width_) return column - 1;
      if (!whole && other < width_) return other;
      fault(1, fmt::format(
                   "record has {} columns without names, none is \"{}\"; a number from 1 to {} is needed",
                   width_, name, width_));
      return no_column;
    };
    constexpr std::size_t of_two = 1;
    columns_.push_back(find(record_.time, 0));
    for (const std::string& name : record_.values)
      columns_.push_back(name.empty() ? no_column : find(name, width_ == 2 ? of_two : no_column));
    return faults_ == 0;
  }

  void add_row(std::string_view line, std::vector<std::vector<double>>& rows) {
    const std::vector<TextField> fields = fields_of(line, separator_);
    std::vector<double> row;
    for (std::size_t k = width_; k < fields.size(); ++k) {
      if (fields[k].text.empty()) continue;
      fault(fields[k].column, fmt::format("row has {} fields, the header has {}; use decimal points, "
                                          "not commas",
                                          fields.size(), width_));
      return;
    }
    for (std::size_t n = 0; n < columns_.size(); ++n) {
      if (columns_[n] == no_column) {
        row.push_back(0.0);
        continue;
      }
      if (columns_[n] >= fields.size()) {
        fault(static_cast<int>(line.size()) + 1,
              fmt::format("row has {} fields, at least {} are needed", fields.size(), columns_[n] + 1));
        return;
      }
      const std::optional<double> value = number(fields[columns_[n]]);
      if (!value) return;
      row.push_back(n == 0 ? *value : *value * record_.scale);
      if (std::isfinite(row.back())) continue;
      fault(fields[columns_[n]].column,
            fmt::format("value times scale is not finite ({} times {}), a number is needed", *value,
                        record_.scale));
      return;
    }
    if (record_.in_order && !rows.empty() && !(row[0] > rows.back()[0])) {
      fault(fields[columns_[0]].column,
            fmt::format("time does not increase ({} after {}), each row must be later than the one before",
                        row[0], rows.back()[0]));
      return;
    }
    rows.push_back(std::move(row));
  }

  std::optional<double> number(const TextField& field) {
    if (const std::optional<double> value = number_of(field.text)) return value;
    constexpr std::size_t longest_shown = 60;
    const bool comma = field.text.find(',') != std::string_view::npos;
    fault(field.column,
          fmt::format("no number (\"{}\"), a finite number{} is needed", field.text.substr(0, longest_shown),
                      comma ? " with a decimal point, not a comma," : ""));
    return std::nullopt;
  }

  static constexpr std::size_t no_column = static_cast<std::size_t>(-1);

  const SceneRecord& record_;
  std::string name_;
  Diagnostics& diagnostics_;
  std::vector<std::size_t> columns_;  ///< of the time and of each value
  std::size_t width_ = 0;             ///< number of fields of the first line
  bool without_names_ = false;        ///< the first line has numbers
  char separator_ = ',';
  int line_ = 0;
  std::size_t faults_ = 0;
};

}  // namespace

std::optional<std::vector<std::vector<double>>> read_record(const SceneRecord& record,
                                                            const std::filesystem::path& folder,
                                                            const Place& place, Diagnostics& diagnostics) {
  const std::filesystem::path path = folder / record.file;
  std::istringstream content;
  try {
    require_readable(path);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
      throw std::runtime_error(std::filesystem::exists(path, ignored) ? "is no file"
                                                                      : "there is no such file");
    content.str(whole_file(path, most_input_bytes));
  } catch (const std::runtime_error& reason) {
    diagnostics.error(place, fmt::format("record cannot be read (\"{}\": {}), a readable record is needed",
                                         path.string(), fault_text(reason)));
    return std::nullopt;
  }
  return parse_record(record, content, path.string(), diagnostics);
}

std::optional<std::vector<std::vector<double>>> parse_record(const SceneRecord& record, std::istream& content,
                                                             const std::string& name,
                                                             Diagnostics& diagnostics) {
  std::string kind = std::filesystem::path(name).extension().string();
  for (char& letter : kind) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (kind == ".v2") return parse_volume2_record(record, content, name, diagnostics);
  if (kind == ".smc") return parse_smc_record(record, content, name, diagnostics);
  return RecordReader(record, name, diagnostics).read(content);
}

}  // namespace ashlar

#include "apps/scene/read/disc_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "apps/scene/records/text_fields.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/input_file.hpp"
#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/text/reading_folder.hpp"

namespace ashlar {
namespace {

constexpr std::array<const char*, 6> columns = {"x", "y", "z", "dip", "dip_direction", "radius"};
constexpr std::size_t dip_column = 3, radius_column = 5;
constexpr std::size_t no_column = static_cast<std::size_t>(-1);

class DiscReader {
 public:
  DiscReader(const std::string& name, Diagnostics& diagnostics) : name_(name), diagnostics_(diagnostics) {}

  std::optional<std::vector<MeasuredJoint>> read(std::istream& content) {
    content.exceptions(std::ios::badbit);
    std::vector<MeasuredJoint> discs;
    for (std::string line; std::getline(content, line);) {
      ++line_;
      const std::string_view text = trimmed_text(line);
      if (text.empty() || text.front() == '#') continue;
      if (!separator_) {
        if (!find_columns(line)) return std::nullopt;
        continue;
      }
      const auto disc = read_disc(fields_of(line, *separator_));
      if (!disc) return std::nullopt;
      discs.push_back(*disc);
    }
    if (!discs.empty()) return discs;
    fault(1, separator_ ? "table has no joint (0 rows), at least 1 is needed"
                        : fmt::format("table is empty, a line of column names ({}) is needed",
                                      fmt::join(columns, ", ")));
    return std::nullopt;
  }

 private:
  void fault(int column, std::string message) {
    diagnostics_.error({name_, std::max(line_, 1), column}, std::move(message));
  }

  bool find_columns(std::string_view line) {
    separator_ = separator_of(line);
    const std::vector<TextField> fields = fields_of(line, *separator_);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto found = std::find_if(fields.begin(), fields.end(),
                                      [&](const TextField& field) { return field.text == columns[k]; });
      at_[k] = found == fields.end() ? no_column : static_cast<std::size_t>(found - fields.begin());
      if (found != fields.end() || k == radius_column) continue;
      fault(1, fmt::format("table has no column \"{}\", columns {} are needed (radius may be left out)",
                           columns[k], fmt::join(columns, ", ")));
      return false;
    }
    return true;
  }

  std::optional<MeasuredJoint> read_disc(const std::vector<TextField>& fields) {
    std::array<std::optional<double>, columns.size()> values;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (at_[k] == no_column) continue;
      if (at_[k] >= fields.size()) {
        if (k == radius_column) continue;
        fault(1, fmt::format("row has {} fields, {} are needed", fields.size(), at_[k] + 1));
        return std::nullopt;
      }
      const TextField& field = fields[at_[k]];
      if (k == radius_column && (field.text.empty() || field.text == "inf")) continue;
      values[k] = number_of(field.text);
      if (!allowed(k, values[k])) {
        constexpr std::size_t longest_shown = 60;
        fault(field.column, fmt::format("{} is out of range (\"{}\"), {} is needed", columns[k],
                                        field.text.substr(0, longest_shown), words(k)));
        return std::nullopt;
      }
    }
    return MeasuredJoint{{*values[0], *values[1], *values[2]},
                         *values[dip_column],
                         *values[dip_column + 1],
                         values[radius_column]};
  }

  static bool allowed(std::size_t column, const std::optional<double>& value) {
    constexpr double steepest = 90.0;
    if (!value || std::abs(*value) > largest_coordinate) return false;
    if (column == dip_column) return *value >= 0.0 && *value <= steepest;
    return column != radius_column || *value > 0.0;
  }

  static const char* words(std::size_t column) {
    if (column == dip_column) return "a number of degrees from 0 to 90";
    return column == radius_column ? "a number > 0, or inf," : "a number";
  }

  const std::string& name_;
  Diagnostics& diagnostics_;
  std::optional<char> separator_;
  std::array<std::size_t, columns.size()> at_ = {};
  int line_ = 0;
};

}  // namespace

std::optional<std::vector<MeasuredJoint>> read_disc_table(const std::filesystem::path& file,
                                                          const Place& place, Diagnostics& diagnostics) {
  std::istringstream content;
  try {
    require_readable(file);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) throw std::runtime_error("there is no such file");
    content.str(whole_file(file, most_input_bytes));
  } catch (const std::runtime_error& reason) {
    diagnostics.error(place,
                      fmt::format("table of joints cannot be read (\"{}\": {}), a readable one is needed",
                                  file.string(), fault_text(reason)));
    return std::nullopt;
  }
  return parse_disc_table(content, file.string(), diagnostics);
}

std::optional<std::vector<MeasuredJoint>> parse_disc_table(std::istream& content, const std::string& name,
                                                           Diagnostics& diagnostics) {
  return DiscReader(name, diagnostics).read(content);
}

}  // namespace ashlar

#include "apps/scene/records/sampled_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>

#include "apps/scene/toml/lower_case.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

using Rows = std::vector<std::vector<double>>;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A finite number that is the whole text but for blanks.
std::optional<double> number(std::string_view field) {
  std::string_view digits = trimmed(field);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = parse_number(digits.data(), digits.data() + digits.size(), value);
  if (status != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// Columns of a series: so many fields of so many characters in a line.
struct Layout {
  std::size_t fields = 8;
  std::size_t width = 10;
};

/// Lines of a file with their numbers, and faults at them.
class Lines {
 public:
  Lines(std::istream& content, const std::string& name, Diagnostics& diagnostics)
      : content_(content), name_(name), diagnostics_(diagnostics) {
    content_.exceptions(std::ios::badbit);
  }

  bool next() {
    if (std::exchange(again_, false)) return true;
    if (!std::getline(content_, line_)) return false;
    ++number_;
    return true;
  }
  /// Lets next() give the present line once more.
  void again() { again_ = true; }
  [[nodiscard]] std::string_view line() const { return line_; }
  void fault(std::size_t column, std::string message) {
    diagnostics_.error({name_, std::max(number_, 1), static_cast<int>(column)}, std::move(message));
  }

 private:
  std::istream& content_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  std::string line_;
  int number_ = 0;
  bool again_ = false;
};

/// Values of a series. @param wanted how many. @return false after a fault
bool read_series(Lines& lines, const Layout& layout, std::size_t wanted, std::vector<double>& values) {
  while (values.size() < wanted) {
    if (!lines.next()) {
      lines.fault(1, fmt::format("record has {} values; its head says {}", values.size(), wanted));
      return false;
    }
    const std::string_view line = lines.line();
    const std::size_t length = line.find_last_not_of(" \t\r") + 1;
    for (std::size_t k = 0; k < layout.fields && k * layout.width < length; ++k) {
      const std::size_t start = k * layout.width;
      const std::string_view field = line.substr(start, std::min(layout.width, length - start));
      const std::optional<double> value = number(field);
      if (!value) {
        lines.fault(
            start + 1,
            fmt::format("no number (\"{}\") after {} of the {} values of the head; a finite number in {} "
                        "columns is needed",
                        trimmed(field), values.size(), wanted, layout.width));
        return false;
      }
      values.push_back(*value);
    }
    if (values.size() > wanted || length > layout.fields * layout.width) {
      lines.fault(1, fmt::format("record has more values than its head says ({})", wanted));
      return false;
    }
  }
  return true;
}

/// True if a line holds values: text after a series is no fault, another value is.
bool holds_values(std::string_view line, const Layout& layout) {
  const std::size_t length = line.find_last_not_of(" \t\r") + 1;
  return length > 0 && number(line.substr(0, std::min(layout.width, length))).has_value();
}

struct Series {
  double interval = 0.0;  ///< s
  std::vector<double> values;
};

std::optional<Rows> rows_of(const std::vector<const Series*>& chosen, double scale, Lines& lines) {
  const auto first =
      std::find_if(chosen.begin(), chosen.end(), [](const Series* of) { return of != nullptr; });
  Rows rows;
  if (first == chosen.end()) {
    lines.fault(1, "values name no series of the record; at least one name is needed");
    return std::nullopt;
  }
  for (std::size_t k = 0; k < (*first)->values.size(); ++k) {
    std::vector<double> row = {static_cast<double>(k) * (*first)->interval};
    for (const Series* of : chosen) {
      row.push_back(of == nullptr ? 0.0 : of->values[k] * scale);
      if (std::isfinite(row.back())) continue;
      lines.fault(1, fmt::format("value times scale is not finite ({} times {}); a number is needed",
                                 of->values[k], scale));
      return std::nullopt;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

struct SeriesHead {
  std::string quantity;
  double count = 0.0;
  Series series;
  Layout layout;
};

/// "(8f10.3)" if there is one; no fields if its numbers are too large for a line.
Layout layout_of(std::string_view line) {
  Layout layout;
  const std::size_t open = line.rfind('(');
  const std::size_t letter = line.find('f', open == std::string_view::npos ? line.size() : open);
  if (letter == std::string_view::npos) return layout;
  constexpr std::size_t longest_line = 10000;
  const auto whole = [&](std::size_t from) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(line.data() + from, line.data() + line.size(), value);
    return error == std::errc::result_out_of_range ? longest_line + 1 : value;
  };
  const std::size_t fields = whole(open + 1), width = whole(letter + 1);
  if (fields > longest_line || width > longest_line) return {0, 0};
  if (fields > 0 && width > 0) layout = {fields, width};
  return layout;
}

/// A line before a series, in lower case; empty if it is none.
std::optional<SeriesHead> head_of_series(const std::string& line) {
  constexpr std::array<std::pair<const char*, const char*>, 3> quantities = {
      {{"points of accel", "acceleration"},
       {"points of veloc", "velocity"},
       {"points of displ", "displacement"}}};
  constexpr std::string_view spaced = "equally spaced at";
  for (const auto& [words, quantity] : quantities) {
    const std::size_t place = line.find(words), interval = line.find(spaced);
    if (place == std::string::npos || interval == std::string::npos) continue;
    const std::string_view after = trimmed(std::string_view(line).substr(interval + spaced.size()));
    const auto count = number(std::string_view(line).substr(0, place));
    const auto step = number(after.substr(0, after.find_first_of(" ,\t")));
    SeriesHead head{quantity, count.value_or(0.0), {step.value_or(0.0), {}}, layout_of(line)};
    return head;
  }
  return std::nullopt;
}

class Volume2Reader {
 public:
  Volume2Reader(const SceneRecord& record, std::istream& content, const std::string& name,
                Diagnostics& diagnostics)
      : record_(record), lines_(content, name, diagnostics) {}

  std::optional<Rows> read() {
    while (lines_.next()) {
      auto head = head_of_series(lower_case(lines_.line()));
      if (!head) {
        if (!series_.empty() && after_series_ && holds_values(lines_.line(), layout_)) {
          lines_.fault(1, fmt::format("record has more values than its head says ({})", last_count_));
          return std::nullopt;
        }
        after_series_ = after_series_ && trimmed(lines_.line()).empty();
        continue;
      }
      if (!read_one(std::move(*head))) return std::nullopt;
    }
    return chosen();
  }

 private:
  bool read_one(SeriesHead head) {
    if (head.layout.fields == 0) {
      lines_.fault(
          1,
          "line before a series has a layout that is too wide; at most 10000 values of 10000 columns, "
          "as (8f10.3), are allowed");
      return false;
    }
    if (!(head.count >= 1.0) || head.count != std::floor(head.count) || !(head.series.interval > 0.0)) {
      lines_.fault(1,
                   "line before a series has no number of values or no interval; \"N points of accel data "
                   "equally spaced at DT sec\" is needed");
      return false;
    }
    last_count_ = static_cast<std::size_t>(head.count);
    layout_ = head.layout;
    if (!read_series(lines_, layout_, last_count_, head.series.values)) return false;
    const int channel = ++channels_[head.quantity];
    series_[channel == 1 ? head.quantity : fmt::format("{}.{}", head.quantity, channel)] =
        std::move(head.series);
    after_series_ = true;
    return true;
  }

  std::optional<Rows> chosen() {
    if (series_.empty()) {
      lines_.fault(
          1,
          "volume 2 record has no series; a line \"N points of accel data equally spaced at DT sec\" "
          "and its values are needed");
      return std::nullopt;
    }
    std::vector<const Series*> chosen;
    const Series* first = nullptr;
    for (const std::string& name : record_.values) {
      const auto found = series_.find(name);
      if (!name.empty() && found == series_.end()) {
        std::vector<std::string> names;
        for (const auto& [known, series] : series_) names.push_back(known);
        lines_.fault(1, fmt::format("record has no series \"{}\"; one of \"{}\" is needed", name,
                                    fmt::join(names, "\", \"")));
        return std::nullopt;
      }
      chosen.push_back(name.empty() ? nullptr : &found->second);
      if (chosen.back() == nullptr) continue;
      if (first == nullptr) first = chosen.back();
      if (first->interval == chosen.back()->interval && first->values.size() == chosen.back()->values.size())
        continue;
      lines_.fault(
          1, fmt::format("series \"{}\" has {} values every {} s, another one {} every {} s; series of "
                         "the same times are needed",
                         name, chosen.back()->values.size(), chosen.back()->interval, first->values.size(),
                         first->interval));
      return std::nullopt;
    }
    return rows_of(chosen, record_.scale, lines_);
  }

  const SceneRecord& record_;
  Lines lines_;
  std::map<std::string, Series> series_;
  std::map<std::string, int> channels_;  ///< by quantity
  Layout layout_;
  std::size_t last_count_ = 0;
  bool after_series_ = false;  ///< only blank lines since the last series
};

/// The numbers of some lines. @return false after a fault
bool read_head_numbers(Lines& lines, int count, const Layout& layout, std::vector<double>& values) {
  for (int k = 0; k < count; ++k) {
    if (!lines.next()) {
      lines.fault(1, "SMC record ends in its head; 11 lines of text, 6 and 10 lines of numbers are needed");
      return false;
    }
    for (std::size_t field = 0; field < layout.fields; ++field) {
      const std::size_t start = field * layout.width;
      const std::string_view text =
          start < lines.line().size() ? lines.line().substr(start, layout.width) : std::string_view{};
      const auto value = number(text);
      if (!value) {
        lines.fault(start + 1,
                    fmt::format("no number (\"{}\") in the head of an SMC record; {} numbers of {} "
                                "columns are needed",
                                trimmed(text), layout.fields, layout.width));
        return false;
      }
      values.push_back(*value);
    }
  }
  return true;
}

/// Layout of the values from the first line: the exponent begins after 1.2345 or 1.2345678.
Layout smc_layout(std::string_view line) {
  constexpr std::size_t last_of_low_precision = 7;
  const std::size_t exponent = line.find_first_of("Ee");
  if (exponent == std::string_view::npos || exponent <= last_of_low_precision) return {8, 10};
  return {5, 14};
}

}  // namespace

std::optional<Rows> parse_volume2_record(const SceneRecord& record, std::istream& content,
                                         const std::string& name, Diagnostics& diagnostics) {
  return Volume2Reader(record, content, name, diagnostics).read();
}
std::optional<Rows> parse_smc_record(const SceneRecord& record, std::istream& content,
                                     const std::string& name, Diagnostics& diagnostics) {
  constexpr int text_lines = 11, whole_lines = 6, number_lines = 10;
  constexpr std::size_t comments_at = 15, count_at = 16, rate_at = 1;
  constexpr double last_kind_of_motion = 4.0;
  Lines lines(content, name, diagnostics);
  for (int k = 0; k < text_lines; ++k) {
    if (!lines.next()) break;
    const std::string_view line = trimmed(lines.line());
    const auto kind = number(line.substr(0, line.find(' ')));
    if (k > 0 || (kind && *kind <= last_kind_of_motion)) continue;
    lines.fault(1,
                "no motion in time in the first line of an SMC record; a line like \"2 CORRECTED "
                "ACCELEROGRAM\", of kinds 0 to 4, is needed");
    return std::nullopt;
  }
  std::vector<double> whole, numbers;
  if (!read_head_numbers(lines, whole_lines, {8, 10}, whole) ||
      !read_head_numbers(lines, number_lines, {5, 15}, numbers))
    return std::nullopt;
  const double count = whole[count_at], rate = numbers[rate_at];
  if (!(count >= 1.0) || count != std::floor(count) || !(rate > 0.0)) {
    lines.fault(
        1, fmt::format("head of the SMC record has no number of values ({}, the 17th whole number) or no "
                       "values in a second ({}, the second number); both are needed",
                       count, rate));
    return std::nullopt;
  }
  for (double k = 0.0; k < whole[comments_at]; ++k)
    if (!lines.next()) break;
  Series series{1.0 / rate, {}};
  Layout layout;
  if (lines.next()) {
    layout = smc_layout(lines.line());
    lines.again();
  }
  if (!read_series(lines, layout, static_cast<std::size_t>(count), series.values)) return std::nullopt;
  while (lines.next()) {
    if (trimmed(lines.line()).empty()) continue;
    lines.fault(1, fmt::format("record goes on after the values that its head says ({})", count));
    return std::nullopt;
  }
  std::vector<const Series*> chosen;
  for (const std::string& column : record.values) chosen.push_back(column.empty() ? nullptr : &series);
  return rows_of(chosen, record.scale, lines);
}

}  // namespace ashlar

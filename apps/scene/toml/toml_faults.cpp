#include "apps/scene/toml/toml_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include "apps/scene/toml/digit.hpp"
#include "geometry/text/parse_number.hpp"

namespace ashlar {
namespace {

constexpr std::array<std::string_view, 6> lists = {"block", "joint", "material", "measure", "fix", "load"};

std::string_view line_of(std::string_view text, std::size_t number) {
  for (std::size_t k = 1; k < number; ++k) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// Key in apostrophes in a parser's message.
std::string_view quoted_in(std::string_view message) {
  const std::size_t start = message.find('\'');
  const std::size_t end = message.rfind('\'');
  return start == end ? std::string_view() : message.substr(start + 1, end - start - 1);
}

/// The parser's words for a number beyond 64 bits or double precision.
bool tells_of_range(std::string_view words) {
  return words.find("is not representable") != std::string_view::npos ||
         words.find("could not be interpreted as a value") != std::string_view::npos;
}

/// End of the number before a fault: at the fault, without blanks.
std::string_view before_fault(std::string_view line, std::size_t column) {
  std::string_view before = line.substr(0, std::min(column - 1, line.size()));
  while (!before.empty() && (before.back() == ' ' || before.back() == '\t')) before.remove_suffix(1);
  return before;
}

/// True for the first letter of a unit; bytes of other alphabets (micro, degree, Angstrom) too.
bool begins_unit(char letter) {
  const auto byte = static_cast<unsigned char>(letter);
  return std::isalpha(byte) != 0 || byte >= 0x80 || letter == '%';
}

}  // namespace

std::string number_out_of_range(std::string_view words) {
  if (!tells_of_range(words)) return {};
  const std::string_view number = quoted_in(words);
  const bool real = number.find_first_of(".eE") != std::string_view::npos && !number.starts_with("0x");
  return real ? fmt::format(
                    "number is out of the range of double precision ({}), 4.9e-324 to 1.7e308 is allowed",
                    number)
              : fmt::format(
                    "whole number is not exact in double precision ({}), whole numbers up to 2^53 are; "
                    "with a decimal point it is rounded",
                    number);
}

std::string malformed_toml(std::string_view text, const toml::parse_error& error) {
  const std::string_view words = error.description();
  if (std::string range = number_out_of_range(words); !range.empty()) return range;
  if (words.find("redefine existing table") != std::string_view::npos) {
    const std::string_view key = quoted_in(words);
    const std::string_view last = key.substr(key.rfind('.') + 1);
    if (std::find(lists.begin(), lists.end(), last) != lists.end())
      return fmt::format("[{}] for one of a list ({}), each entry of a list is headed [[{}]]", key, words,
                         key);
    if (!key.empty()) return fmt::format("{} is given twice ({}), once is allowed", key, words);
  }
  const toml::source_position& position = error.source().begin;
  const std::string_view line = line_of(text, position.line);
  const std::size_t column = position.column;
  const std::string_view before = before_fault(line, column);
  const std::string_view after = column <= line.size() ? line.substr(column - 1) : std::string_view();
  const bool behind_number = !before.empty() && (is_digit(before.back()) || before.back() == '.');
  if (behind_number && !after.empty()) {
    if (begins_unit(after.front()))
      return fmt::format("a unit behind a number ({}), numbers have no unit: SI units, degrees", words);
    if (after.front() == ',' && after.size() > 1 && is_digit(after[1]))
      return fmt::format("a comma in a number ({}), a decimal point is needed", words);
  }
  return fmt::format("malformed TOML ({}), a scene is a TOML 1.0 file", words);
}

std::string number_hint(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [stop, status] = parse_number(text.data(), text.data() + text.size(), value);
  if (status != std::errc()) return {};
  const std::string_view rest = text.substr(static_cast<std::size_t>(stop - text.data()));
  if (rest.size() > 1 && rest.front() == ',' && is_digit(rest[1]))
    return "; a decimal point, not a comma, no quotes";
  return rest.empty() ? "; a number has no quotes"
                      : "; a number has no unit and no quotes (SI units, degrees)";
}

}  // namespace ashlar

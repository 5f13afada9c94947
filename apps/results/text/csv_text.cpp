#include "apps/results/text/csv_text.hpp"

#include <array>
#include <cmath>

#include "geometry/text/parse_number.hpp"
#include "geometry/text/write_number.hpp"

namespace ashlar {
namespace {

/// True if a spreadsheet would evaluate the field, or would without leading apostrophes.
bool looks_like_formula(std::string_view field) {
  const std::size_t start = field.find_first_not_of('\'');
  return start != std::string_view::npos &&
         std::string_view("=+-@\t\r").find(field[start]) != std::string_view::npos;
}

}  // namespace

void append_csv_number(std::string& text, double value) {
  std::array<char, longest_number> digits;
  const bool whole = std::trunc(value) == value && std::abs(value) < 1e15;
  text.append(digits.data(),
              write_number(digits.data(), value, whole ? NumberForm::fixed : NumberForm::shorter));
}

std::optional<double> csv_number(std::string_view field) {
  double number = 0.0;
  const char* const end = field.data() + field.size();
  const auto result = parse_number(field.data(), end, number);
  return result.ec == std::errc() && result.ptr == end ? std::optional(number) : std::nullopt;
}

std::string quote_csv_field(std::string_view text) {
  std::string field = looks_like_formula(text) ? '\'' + std::string(text) : std::string(text);
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::vector<std::string> split_csv_line(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::string unmarked_csv_field(std::string_view field) {
  const bool marked = field.starts_with('\'') && looks_like_formula(field);
  return std::string(marked ? field.substr(1) : field);
}

}  // namespace ashlar

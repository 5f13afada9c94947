#include "apps/scene/toml/toml_reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <map>
#include <sstream>
#include <vector>

#include "apps/scene/model/nearest_name.hpp"

namespace ashlar {

namespace {

// Numbers in the shortest form that reads back the same, with a point if they are not integers.
std::string as_text(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (const auto* number = node.as_floating_point()) return fmt::format("{:#}", **number);
  if (const auto* string = node.as_string()) return fmt::format("\"{}\"", **string);
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> entries;
    for (const toml::node& entry : *array) entries.push_back(as_text(entry));
    return fmt::format("[{}]", fmt::join(entries, ", "));
  }
  std::ostringstream stream;
  node.visit([&](const auto& value) { stream << value; });
  return stream.str();
}

// Place of a run of letters of a dotted key with too many dots; the end if there is none. Numbers are separated by
// commas.
std::string_view::const_iterator find_deep_key(std::string_view text) {
  constexpr int most_parts = 1000;
  int dots = 0;
  return std::find_if(text.begin(), text.end(), [&](unsigned char letter) {
    const bool in_key =
        std::isalnum(letter) != 0 || letter >= 0x80 ||
        std::string_view("_-\"' \t").find(static_cast<char>(letter)) != std::string_view::npos;
    if (letter == '.')
      ++dots;
    else if (!in_key)
      dots = 0;
    return dots >= most_parts;
  });
}

/// True if double precision has this number: it has at most 53 digits in base 2 before its zeros at the end.
bool is_exact_in_double(std::int64_t number) {
  constexpr int mantissa_digits = 53;
  const auto bits = static_cast<std::uint64_t>(number);
  const std::uint64_t size = number < 0 ? 0 - bits : bits;
  return size == 0 || std::bit_width(size) - std::countr_zero(size) <= mantissa_digits;
}

[[noreturn]] void refuse_number(std::string_view text, const toml::source_position& place) {
  // In the words of the parser for whole numbers that 64 bits do not have.
  throw toml::parse_error(fmt::format("'{}' is not representable in double precision", text).c_str(), place);
}

/// Refuses whole numbers that double precision does not have, and collects places of real numbers that are zero.
void check_numbers(const toml::node& node, std::vector<toml::source_position>& zeros) {
  if (const auto* whole = node.as_integer(); whole != nullptr && !is_exact_in_double(**whole))
    refuse_number(std::to_string(**whole), node.source().begin);
  if (const auto* real = node.as_floating_point(); real != nullptr && **real == 0.0)
    zeros.push_back(node.source().begin);
  if (const toml::array* array = node.as_array())
    for (const toml::node& entry : *array) check_numbers(entry, zeros);
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table) check_numbers(value, zeros);
}

/// Refuses 1e-400, which the parser reads as zero.
void refuse_lost_numbers(std::string_view text, std::vector<toml::source_position> zeros) {
  std::sort(zeros.begin(), zeros.end());
  const auto continues = [&](std::size_t k) {  // a character of several bytes
    return k < text.size() && (static_cast<unsigned char>(text[k]) & 0xc0U) == 0x80U;
  };
  toml::source_position at{1, 1};
  std::size_t offset = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
  for (const toml::source_position& zero : zeros) {
    for (; at < zero && offset < text.size(); ++offset) {
      if (text[offset] == '\n')
        at = {at.line + 1, 1};
      else if (!continues(offset + 1))
        ++at.column;
    }
    const std::string_view number =
        text.substr(offset, std::min(text.find_first_of(",]}# \t\r\n", offset), text.size()) - offset);
    if (number.substr(0, number.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos)
      refuse_number(number, zero);
  }
}

toml::table parsed_twice(std::string_view text, std::string_view origin) {
  try {
    return toml::parse(text, origin);
  } catch (const toml::parse_error&) {
    // It reads numbers through streams, which swallow a failed allocation: "0.5" is then not a number. Malformed text
    // fails the second time too.
    return toml::parse(text, origin);
  }
}

}  // namespace

toml::table parse_toml(std::string_view text, std::string_view origin) {
  const auto deep = find_deep_key(text);
  if (deep != text.end()) {
    const std::string_view before = text.substr(0, static_cast<std::size_t>(deep - text.begin()));
    toml::source_position position;
    position.line = static_cast<toml::source_index>(1 + std::count(before.begin(), before.end(), '\n'));
    position.column = static_cast<toml::source_index>(before.size() - (before.rfind('\n') + 1) + 1);
    throw toml::parse_error("a key of more than 1000 parts", position);
  }
  toml::table document = parsed_twice(text, origin);
  std::vector<toml::source_position> zeros;
  check_numbers(document, zeros);
  refuse_lost_numbers(text, std::move(zeros));
  return document;
}

double number_in(const toml::node& node) {
  const auto* whole = node.as_integer();
  return whole != nullptr ? static_cast<double>(**whole) : **node.as_floating_point();
}

std::string describe(const toml::node& node) {
  constexpr std::size_t longest_shown = 60;
  std::string text = as_text(node);
  if (text.size() <= longest_shown) return text;
  if (const toml::array* array = node.as_array()) return fmt::format("an array of {} entries", array->size());
  return fmt::format("a text of {} letters", text.size() - 2);  // without its quotes
}

Place TomlReading::place(const toml::source_region& region) const {
  const std::string& file = region.path ? *region.path : files_.front();
  if (std::find(files_.begin(), files_.end(), file) == files_.end()) return {file, 0, 0};
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

bool TomlReading::has_number(const toml::node& node) {
  const auto* text = node.as_string();
  return node.is_number() || (text != nullptr && is_formula(**text));
}

// Place of a character in a quoted text. If characters were escaped or the text has several lines, they cannot be
// counted, and the place is that of the text.
Place TomlReading::place_in_text(const toml::node& node, std::size_t offset) const {
  Place start = place(node.source());
  const toml::source_region& region = node.source();
  const std::size_t quoted = (**node.as_string()).size() + 2;
  const bool as_written = region.begin.line == region.end.line &&
                          static_cast<std::size_t>(region.end.column - region.begin.column) == quoted;
  if (start.line > 0 && as_written) start.column += 1 + static_cast<int>(offset);
  return start;
}

std::optional<double> TomlReading::number(const toml::node& node, std::string_view key) {
  return number(node, key, formulas_);
}

std::optional<double> TomlReading::number(const toml::node& node, std::string_view key,
                                          const Formulas& formulas) {
  if (node.is_number()) return number_in(node);
  try {
    return formulas.value(**node.as_string());
  } catch (const FormulaError& fault) {
    if (*fault.what() != '\0')
      error(place_in_text(node, fault.offset()),
            fmt::format("{} ({}): {}", key, describe(node), fault.what()));
    return std::nullopt;
  }
}

std::function<double(const Vector3&)> TomlReading::function(const toml::node& node, std::string_view key) {
  if (node.is_number()) return [value = number_in(node)](const Vector3&) { return value; };
  try {
    return formulas_.of_place(**node.as_string());
  } catch (const FormulaError& fault) {
    if (*fault.what() != '\0')
      error(place_in_text(node, fault.offset()),
            fmt::format("{} ({}): {}", key, describe(node), fault.what()));
    return nullptr;
  }
}

TomlReading::KnownTable& TomlReading::add_table(const toml::table& table, std::string path,
                                                std::string name) {
  for (const auto& [key, node] : table) {
    const std::string key_path =
        path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str());
    places_.record(key_path, {place(key.source()), place(node.source())});
  }
  return tables_.emplace_back(KnownTable{&table, std::move(path), std::move(name), {}});
}

void TomlReading::record_place(const std::string& path, const toml::node& node) {
  places_.record(path, {place(node.source()), place(node.source())});
}

void TomlReading::error(const toml::node& node, std::string message) {
  error(place(node.source()), std::move(message));
}

void TomlReading::report_unknown_keys() {
  // Names of the tables in which each key is known.
  std::map<std::string, std::set<std::string>> homes;
  for (const KnownTable& table : tables_)
    for (const std::string& key : table.keys)
      homes[key].insert(table.name.empty() ? "the top of the file" : table.name);
  for (const KnownTable& table : tables_)
    for (const auto& [key_node, value] : *table.table) {
      const std::string key(key_node.str());
      if (table.keys.contains(key)) continue;
      const std::string where = table.name.empty() ? "" : fmt::format(" in {}", table.name);
      const auto home = homes.find(key);
      const std::vector<std::string> known(table.keys.begin(), table.keys.end());
      const std::string suggestion =
          home != homes.end() ? fmt::format("{} belongs to {}", key, fmt::join(home->second, " or "))
                              : fmt::format("{}known here: {}", guess(key, known), fmt::join(known, ", "));
      error(place(key_node.source()), fmt::format("unknown key{} ({}), {}", where, key, suggestion));
    }
}

}  // namespace ashlar

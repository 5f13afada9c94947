#include "apps/scene/toml/toml_table_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace ashlar {

std::string TomlTableReader::path(std::string_view key) const {
  return known_.path.empty() ? std::string(key) : fmt::format("{}.{}", known_.path, key);
}

std::string TomlTableReader::child_name(std::string_view key) const {
  return known_.name.empty() ? std::string(key) : fmt::format("{}.{}", known_.name, key);
}

const toml::node* TomlTableReader::find(std::string_view key) {
  if (!known_.keys.contains(key)) known_.keys.emplace(key);
  return known_.table->get(key);
}

void TomlTableReader::refuse_former(std::string_view key, std::string message) {
  if (!known_.table->contains(key)) return;
  known_.keys.emplace(key);
  error_at_key(key, std::move(message));
}

bool TomlTableReader::holds_infinity(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_floating_point() &&
         number_in(*node) == std::numeric_limits<double>::infinity();
}

void TomlTableReader::require(std::string_view key) {
  if (given(key)) return;
  const std::string where = known_.name.empty() ? "the top of the file" : known_.name;
  reading_.error(reading_.places().key(known_.path),
                 fmt::format("missing key ({}), {} needs it", key, where));
}

void TomlTableReader::error_at_table(std::string message) {
  reading_.error(reading_.places().key(known_.path), std::move(message));
}

void TomlTableReader::error_at_key(std::string_view key, std::string message) {
  reading_.error(reading_.places().key(path(key)), std::move(message));
}

void TomlTableReader::error_at_value(std::string_view key, std::string message) {
  reading_.error(reading_.places().value(path(key)), std::move(message));
}

bool TomlTableReader::read_bool(std::string_view key, bool& result, const char* form) {
  const toml::node* node = find(key);
  if (!node) return false;
  if (!node->is_boolean()) {
    value(*node, key).wrong_type(fmt::format("true or false{}", form));
    return false;
  }
  result = **node->as_boolean();
  return true;
}

bool TomlTableReader::read_text(std::string_view key, std::string& result) {
  const toml::node* node = find(key);
  if (!node) return false;
  if (!node->is_string()) {
    value(*node, key).wrong_type("a text in quotes");
    return false;
  }
  result = **node->as_string();
  return true;
}

bool TomlTableReader::read_name(std::string_view key, std::string& result) {
  std::string name;
  if (!read_text(key, name)) return false;
  const auto control = [](unsigned char letter) { return letter < ' '; };
  if (name.empty() || std::any_of(name.begin(), name.end(), control)) {
    error_at_value(
        key, fmt::format("{} cannot be used as a name ({}), a text of one line, not empty, is needed", key,
                         describe(*known_.table->get(key))));
    return false;
  }
  result = std::move(name);
  return true;
}

bool TomlTableReader::read_number(std::string_view key, double& result, const NumberRange& range) {
  const toml::node* node = find(key);
  if (!node) return false;
  const std::optional<double> number = value(*node, key).number(range);
  if (number) result = *number;
  return number.has_value();
}

bool TomlTableReader::read_number(std::string_view key, std::optional<double>& result,
                                  const NumberRange& range) {
  double number = 0.0;
  if (!read_number(key, number, range)) return false;
  result = number;
  return true;
}

bool TomlTableReader::read_number_or_auto(std::string_view key, std::optional<double>& result,
                                          const NumberRange& range) {
  return read_number_or(key, "auto", result, range);
}

bool TomlTableReader::read_number_or_word(std::string_view key, const char* word,
                                          std::optional<double>& result, const NumberRange& range) {
  return read_number_or(key, word, result, range);
}

bool TomlTableReader::read_number_or(std::string_view key, std::string_view word,
                                     std::optional<double>& result, const NumberRange& range) {
  const toml::node* node = find(key);
  if (!node) return false;
  if (const auto* text = node->as_string(); text && **text == word) {
    result.reset();
    return true;
  }
  const std::string words = fmt::format("{} or \"{}\"", range.words, word);
  return read_number(key, result,
                     {range.low, range.high, range.low_allowed, range.high_allowed, words.c_str()});
}

bool TomlTableReader::read_integer(std::string_view key, int& result, int low, int high) {
  const toml::node* node = find(key);
  if (!node) return false;
  const std::optional<int> number = value(*node, key).whole_number(low, high);
  if (number) result = *number;
  return number.has_value();
}

bool TomlTableReader::read_integers(std::string_view key, std::vector<int>& result, int low, int high) {
  const toml::array* array = find_array(key, fmt::format("an array of {}", whole_number_words(low, high)));
  if (!array) return false;
  std::vector<int> integers;
  for (const toml::node& entry : *array)
    if (const auto number = value(entry, key).whole_number(low, high)) integers.push_back(*number);
  if (integers.size() != array->size()) return false;
  result = std::move(integers);
  return true;
}

bool TomlTableReader::read_integer(std::string_view key, std::optional<int>& result, int low, int high) {
  int number = 0;
  if (!read_integer(key, number, low, high)) return false;
  result = number;
  return true;
}

bool TomlTableReader::read_integer_or_auto(std::string_view key, std::optional<int>& result, int low,
                                           int high) {
  const toml::node* node = find(key);
  if (!node) return false;
  if (const auto* text = node->as_string(); text && **text == "auto") {
    result.reset();
    return true;
  }
  const std::optional<int> number = value(*node, key).whole_number(low, high, " or \"auto\"");
  if (number) result = number;
  return number.has_value();
}

std::optional<std::size_t> TomlTableReader::read_word(std::string_view key,
                                                      const std::vector<std::string>& words) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return value(*node, key).word(words);
}

bool TomlTableReader::read_words_among(std::string_view key, std::vector<std::string>& result,
                                       const std::vector<std::string>& words) {
  const toml::array* array = find_array(key, fmt::format("an array of \"{}\"", fmt::join(words, "\", \"")));
  if (!array) return false;
  std::vector<std::string> found;
  for (const toml::node& entry : *array) {
    const std::optional<std::size_t> index = value(entry, key).word(words);
    if (!index) continue;
    const std::string& word = words[*index];
    if (std::find(found.begin(), found.end(), word) != found.end())
      reading_.error(entry, fmt::format("{} names something twice (\"{}\"), once is enough", key, word));
    else
      found.push_back(word);
  }
  if (found.size() != array->size()) return false;
  result = std::move(found);
  return true;
}

const toml::array* TomlTableReader::find_array(std::string_view key, const std::string& words) {
  const toml::node* node = find(key);
  if (!node) return nullptr;
  if (!node->is_array()) value(*node, key).wrong_type(words);
  return node->as_array();
}

bool TomlTableReader::read_vector(std::string_view key, Vector3& result) {
  const toml::node* node = find(key);
  if (!node) return false;
  const auto row = value(*node, key).row(3, "[x, y, z]");
  if (!row) return false;
  result = Vector3((*row)[0], (*row)[1], (*row)[2]);
  return true;
}

bool TomlTableReader::read_place(std::string_view key, Vector3& result) {
  Vector3 place;
  if (!read_vector(key, place) || !value(*find(key), key).holds_place(place)) return false;
  result = place;
  return true;
}

bool TomlTableReader::read_places(std::string_view key, std::vector<Vector3>& result, std::size_t minimum) {
  std::vector<std::vector<double>> rows;
  if (!read_rows(key, rows, 3, minimum, "[x, y, z]")) return false;
  const toml::array& entries = *find(key)->as_array();
  std::vector<Vector3> places;
  for (const auto& row : rows) {
    places.emplace_back(row[0], row[1], row[2]);
    if (!value(entries[places.size() - 1], key).holds_place(places.back())) return false;
  }
  result = std::move(places);
  return true;
}

bool TomlTableReader::varies(std::string_view key) {
  const toml::node* node = find(key);
  const toml::array* array = node == nullptr ? nullptr : node->as_array();
  if (array == nullptr) return false;
  return std::any_of(array->begin(), array->end(), [&](const toml::node& entry) {
    const auto* text = entry.as_string();
    if (text == nullptr || !is_formula(**text)) return false;
    const std::vector<Formulas::Name> names = Formulas::parameters_in(**text);
    return std::any_of(names.begin(), names.end(), [&](const Formulas::Name& name) {
      return (name.text == "x" || name.text == "y" || name.text == "z") &&
             !reading_.formulas().knows(name.text);
    });
  });
}

bool TomlTableReader::read_field(std::string_view key, SceneField& result, std::size_t width,
                                 const char* words) {
  const toml::array* array = find_array(key, words);
  if (!array) return false;
  if (array->size() != width) {
    reading_.error(
        *array, fmt::format("{} has the wrong length ({} entries), {} is needed", key, array->size(), words));
    return false;
  }
  SceneField field;
  std::vector<std::function<double(const Vector3&)>> functions;
  for (const toml::node& entry : *array) {
    if (!TomlReading::has_number(entry)) {
      value(entry, key).wrong_type("a number, or a formula of x, y and z");
      continue;
    }
    if (entry.is_number() && !value(entry, key).finite_number("a number")) continue;
    functions.push_back(reading_.function(entry, key));
    if (functions.back() == nullptr) return false;
    if (entry.is_number())
      field.written.emplace_back(number_in(entry));
    else
      field.written.emplace_back(reading_.formulas().with_values(**entry.as_string()));
  }
  if (functions.size() != width) return false;
  field.at = [functions](const Vector3& place) {
    std::vector<double> values;
    values.reserve(functions.size());
    for (const auto& function : functions) values.push_back(function(place));
    return values;
  };
  result = std::move(field);
  return true;
}

bool TomlTableReader::read_row(std::string_view key, std::vector<double>& result, std::size_t width,
                               const char* words) {
  const toml::node* node = find(key);
  if (node == nullptr) return false;
  auto row = value(*node, key).row(width, words);
  if (row) result = std::move(*row);
  return row.has_value();
}

bool TomlTableReader::read_texts(std::string_view key, std::vector<std::string>& result, const char* form) {
  const toml::array* array = find_array(key, fmt::format("an array of texts{}", form));
  if (!array) return false;
  std::vector<std::string> texts;
  for (const toml::node& entry : *array) {
    if (const auto* text = entry.as_string())
      texts.push_back(**text);
    else
      value(entry, key).wrong_type("a text in quotes");
  }
  if (texts.size() != array->size()) return false;
  result = std::move(texts);
  return true;
}

bool TomlTableReader::read_rows(std::string_view key, std::vector<std::vector<double>>& result,
                                std::size_t width, std::size_t minimum, const char* words, const char* form) {
  const toml::array* array = find_array(key, fmt::format("an array of {}{}", words, form));
  if (!array) return false;
  if (array->size() < minimum) {
    reading_.error(*array, fmt::format("{} has too few entries ({}), at least {} of {} are needed", key,
                                       array->size(), minimum, words));
    return false;
  }
  std::vector<std::vector<double>> rows;
  for (const toml::node& entry : *array)
    if (auto row = value(entry, key).row(width, words)) rows.push_back(std::move(*row));
  if (rows.size() != array->size()) return false;
  result = std::move(rows);
  return true;
}

bool TomlTableReader::read_history(std::string_view key, std::vector<std::vector<double>>& result,
                                   std::size_t width, const char* words, const char* form) {
  std::vector<std::vector<double>> rows;
  if (!read_rows(key, rows, width, 1, words, form)) return false;
  const toml::array& entries = *find(key)->as_array();
  bool increasing = true;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i][0] > rows[i - 1][0]) continue;
    increasing = false;
    reading_.error(entries[i],
                   fmt::format("time in {} does not increase ({} after {}), each entry must be later than "
                               "the one before",
                               key, rows[i][0], rows[i - 1][0]));
  }
  if (increasing) result = std::move(rows);
  return increasing;
}

std::optional<TomlTableReader> TomlTableReader::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) {
    value(*node, key).wrong_type("a table");
    return std::nullopt;
  }
  return TomlTableReader(reading_, *node->as_table(), path(key), child_name(key));
}

TomlTableReader TomlTableReader::empty_table(std::string_view key) {
  static const toml::table empty;
  return {reading_, empty, path(key), child_name(key)};
}

std::vector<std::optional<TomlTableReader>> TomlTableReader::tables(std::string_view key) {
  const std::string name = child_name(key);
  const toml::array* array = find_array(key, fmt::format("a list of tables, each headed [[{}]],", name));
  std::vector<std::optional<TomlTableReader>> result;
  if (!array) return result;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& entry = *array->get(i);
    const std::string entry_path = fmt::format("{}.{}", path(key), i);
    if (!entry.is_table()) {
      value(entry, key).wrong_type("a table");
      result.emplace_back();
      continue;
    }
    reading_.record_place(entry_path, entry);
    result.emplace_back(std::in_place, reading_, *entry.as_table(), entry_path, name);
  }
  return result;
}

}  // namespace ashlar

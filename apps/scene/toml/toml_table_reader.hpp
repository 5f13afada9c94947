// Reads one TOML table key by key. Every fault goes to the diagnostics with its place. A value is returned only after
// its type, range and finiteness are checked.
#pragma once

#include <toml++/toml.h>

#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/scene/model/scene_field.hpp"
#include "apps/scene/toml/number_ranges.hpp"
#include "apps/scene/toml/toml_reading.hpp"
#include "apps/scene/toml/toml_value.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// One table. Each read_... leaves its result unchanged if the key is absent or faulty, and returns true if a valid
/// value was read.
class TomlTableReader {
 public:
  /// @param path,name see TomlReading::KnownTable. @param table must outlive the reader.
  TomlTableReader(TomlReading& reading, const toml::table& table, std::string path, std::string name)
      : reading_(reading), known_(reading.add_table(table, std::move(path), std::move(name))) {}

  [[nodiscard]] const std::string& path() const { return known_.path; }
  [[nodiscard]] const std::string& name() const { return known_.name; }
  [[nodiscard]] std::string path(std::string_view key) const;
  /// True if the key is present, valid or not. Makes it a known one.
  [[nodiscard]] bool given(std::string_view key) { return find(key) != nullptr; }
  /// True if the key holds inf. Makes it a known one.
  [[nodiscard]] bool holds_infinity(std::string_view key);
  /// The table of the key, null if there is none. Makes it a known one.
  [[nodiscard]] const toml::table* table_at(std::string_view key) {
    const toml::node* node = find(key);
    return node == nullptr ? nullptr : node->as_table();
  }
  [[nodiscard]] TomlReading& reading() { return reading_; }
  /// Reports a missing key at the table's place.
  void require(std::string_view key);
  void error_at_table(std::string message);
  void error_at_key(std::string_view key, std::string message);
  void error_at_value(std::string_view key, std::string message);
  /// Reports a key of earlier versions, if given.
  void refuse_former(std::string_view key, std::string message);

  /// True if the key holds a text. Makes it a known one.
  [[nodiscard]] bool text_at(std::string_view key) {
    const toml::node* node = find(key);
    return node != nullptr && node->is_string();
  }
  /// @param form description of other values of the key
  bool read_bool(std::string_view key, bool& result, const char* form = "");
  bool read_text(std::string_view key, std::string& result);
  /// A text of at least one character and no control characters (tabs, line breaks).
  bool read_name(std::string_view key, std::string& result);
  bool read_number(std::string_view key, double& result, const NumberRange& range);
  bool read_number(std::string_view key, std::optional<double>& result, const NumberRange& range);
  /// "auto" makes the result empty.
  bool read_number_or_auto(std::string_view key, std::optional<double>& result, const NumberRange& range);
  /// The word makes the result empty.
  bool read_number_or_word(std::string_view key, const char* word, std::optional<double>& result,
                           const NumberRange& range);
  bool read_integer(std::string_view key, int& result, int low, int high);
  bool read_integer(std::string_view key, std::optional<int>& result, int low, int high);
  /// "auto" makes the result empty.
  bool read_integer_or_auto(std::string_view key, std::optional<int>& result, int low, int high);
  /// An array of some whole numbers.
  bool read_integers(std::string_view key, std::vector<int>& result, int low, int high);
  bool read_vector(std::string_view key, Vector3& result);
  /// A vector of coordinates or lengths, m, none beyond largest_coordinate.
  bool read_place(std::string_view key, Vector3& result);
  /// An array of numbers, or formulas of x, y and z. @param words description of the array
  bool read_field(std::string_view key, SceneField& result, std::size_t width, const char* words);
  /// True if the key holds an array with a formula of x, y or z, which no parameters are.
  [[nodiscard]] bool varies(std::string_view key);
  /// Some finite numbers. @param words name of them all: "[a, b]"
  bool read_row(std::string_view key, std::vector<double>& result, std::size_t width, const char* words);
  /// @param form description of a table that is another value of the key
  bool read_texts(std::string_view key, std::vector<std::string>& result, const char* form = "");
  /// An array of at least `minimum` rows of `width` finite numbers each. @param words name of a row.
  bool read_rows(std::string_view key, std::vector<std::vector<double>>& result, std::size_t width,
                 std::size_t minimum, const char* words, const char* form = "");
  /// Rows of three coordinates, as read_rows and read_place.
  bool read_places(std::string_view key, std::vector<Vector3>& result, std::size_t minimum);
  /// Rows whose first number is a time, which must increase from row to row. @param form description of other values
  /// of the key
  bool read_history(std::string_view key, std::vector<std::vector<double>>& result, std::size_t width,
                    const char* words, const char* form = "");

  /// One of several words. @return its index
  [[nodiscard]] std::optional<std::size_t> read_word(std::string_view key,
                                                     const std::vector<std::string>& words);
  /// An array of some of several words, each at most once.
  bool read_words_among(std::string_view key, std::vector<std::string>& result,
                        const std::vector<std::string>& words);
  /// One of several words.
  template <typename Names, typename Choice>
  bool read_choice(std::string_view key, Choice& result, const Names& names) {
    std::vector<std::string> words;
    words.reserve(std::size(names));
    for (const auto& [word, choice] : names) words.emplace_back(word);
    const std::optional<std::size_t> index = read_word(key, words);
    if (index) result = names[*index].second;
    return index.has_value();
  }

  /// A table; empty if absent or faulty.
  [[nodiscard]] std::optional<TomlTableReader> table(std::string_view key);
  /// An empty one in place of the table of a key, whose keys it makes known.
  [[nodiscard]] TomlTableReader empty_table(std::string_view key);
  /// Results of `read` for each entry of an array of tables. An entry that is no table is a fault with a default
  /// result, so that indices are preserved; empty if absent or no array.
  template <typename Read>
  [[nodiscard]] auto read_tables(std::string_view key, Read read) {
    using Entry = std::invoke_result_t<Read, TomlTableReader&>;
    std::vector<Entry> entries;
    for (std::optional<TomlTableReader>& table : tables(key))
      entries.push_back(table ? read(*table) : Entry());
    return entries;
  }

 private:
  bool read_number_or(std::string_view key, std::string_view word, std::optional<double>& result,
                      const NumberRange& range);
  /// Null for entries that are no tables.
  [[nodiscard]] std::vector<std::optional<TomlTableReader>> tables(std::string_view key);
  [[nodiscard]] const toml::node* find(std::string_view key);
  [[nodiscard]] const toml::array* find_array(std::string_view key, const std::string& words);
  [[nodiscard]] std::string child_name(std::string_view key) const;
  /// A node held by the key, or an element of its array.
  [[nodiscard]] TomlValue value(const toml::node& node, std::string_view key) {
    return {reading_, node, key};
  }

  TomlReading& reading_;
  TomlReading::KnownTable& known_;
};

}  // namespace ashlar

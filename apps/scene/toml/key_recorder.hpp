// Records the keys that a reader requests from each table: the schema of scenes (scene_schema.hpp) is derived from
// the reader, not from a second description.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/toml/number_ranges.hpp"

namespace ashlar {

/// One form of a key's value.
struct KeyForm {
  enum class Kind {
    boolean,
    text,
    number,
    whole_number,
    automatic,      ///< "auto"
    word,           ///< one of some words
    words,          ///< an array of such words
    texts,          ///< an array of texts
    whole_numbers,  ///< an array of whole numbers
    row,            ///< an array of so many numbers
    rows,           ///< an array of rows
    record,         ///< { file, time, values, scale }
    table,
    tables,  ///< an array of tables
  };
  Kind kind;
  NumberRange range = range::any_number;  ///< of a number; whole numbers have low and high
  std::vector<std::string> words = {};
  std::size_t width = 0;    ///< of a row
  std::size_t minimum = 0;  ///< rows
};

/// By name of the table as in a header: "block.fix"; "" is the top.
class KeyRecorder {
 public:
  struct Table {
    int read = 0;  ///< times
    std::map<std::string, std::vector<KeyForm>> keys;
    std::map<std::string, int> required;  ///< number of times the table was found to need them
  };

  void note_table(const std::string& name) { ++tables_[name].read; }
  void note_key(const std::string& table, const std::string& key) { tables_[table].keys[key]; }
  void note_form(const std::string& table, const std::string& key, KeyForm form) {
    tables_[table].keys[key].push_back(std::move(form));
  }
  void note_required(const std::string& table, const std::string& key) { ++tables_[table].required[key]; }

  [[nodiscard]] const std::map<std::string, Table>& tables() const { return tables_; }

 private:
  std::map<std::string, Table> tables_;
};

}  // namespace ashlar

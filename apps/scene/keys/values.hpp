// Values of keys: numbers, words, places, lists, tables. Each function declares a key by its name, the member that holds
// it, its limits, its unit ("" if it has none) and its meaning.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/scene/keys/schema_parts.hpp"
#include "apps/scene/keys/table_keys.hpp"
#include "apps/scene/model/scene_field.hpp"
#include "apps/scene/read/history_reader.hpp"

namespace ashlar::keys {

using Shared = std::shared_ptr<const Values>;

// By type of the member; null members only choose the type.
[[nodiscard]] Shared number_values(const double*, const NumberRange& range);
[[nodiscard]] Shared number_values(const std::optional<double>*, const NumberRange& range);
[[nodiscard]] Shared number_or_word(const std::optional<double>*, const NumberRange& range, const char* word);
/// An empty inner optional is the word.
[[nodiscard]] Shared number_or_word(const std::optional<std::optional<double>>*, const NumberRange& range,
                                    const char* word);
[[nodiscard]] Shared whole_values(const int*, int low, int high);
[[nodiscard]] Shared whole_values(const std::optional<int>*, int low, int high);
[[nodiscard]] Shared flag_values(const bool*);
[[nodiscard]] Shared flag_values(const std::optional<bool>*);
[[nodiscard]] Shared text_values(const std::string*);
[[nodiscard]] Shared name_values(const std::string*);
[[nodiscard]] Shared name_values(const std::optional<std::string>*);
/// Name of a file, as written.
[[nodiscard]] Shared name_values(const std::filesystem::path*);
[[nodiscard]] Shared names_values(const std::vector<std::string>*);
[[nodiscard]] Shared pair_values(const std::array<std::string, 2>*);
[[nodiscard]] Shared row_values(const std::array<double, 2>*, const char* words);
[[nodiscard]] Shared field_values(const SceneField*, std::size_t width, const char* words);

enum class Vector {
  any,
  place,      ///< coordinates, m
  direction,  ///< not zero
};
[[nodiscard]] Shared vector_values(const Vector3*, Vector kind);
[[nodiscard]] Shared vector_values(const std::optional<Vector3>*, Vector kind);

template <class Struct, class Member>
Key<Struct> number(const char* name, Member Struct::*member, const NumberRange& range, const char* unit,
                   const char* meaning) {
  return key_of(name, member, number_values(static_cast<const Member*>(nullptr), range), unit, meaning);
}
/// A number, or a word for an empty optional: "auto".
template <class Struct, class Member>
Key<Struct> number_or(const char* word, const char* name, Member Struct::*member, const NumberRange& range,
                      const char* unit, const char* meaning) {
  return key_of(name, member, number_or_word(static_cast<const Member*>(nullptr), range, word), unit,
                meaning);
}
template <class Struct, class Member>
Key<Struct> whole(const char* name, Member Struct::*member, int low, int high, const char* unit,
                  const char* meaning) {
  return key_of(name, member, whole_values(static_cast<const Member*>(nullptr), low, high), unit, meaning);
}
template <class Struct, class Member>
Key<Struct> flag(const char* name, Member Struct::*member, const char* meaning) {
  return key_of(name, member, flag_values(static_cast<const Member*>(nullptr)), "", meaning);
}
template <class Struct>
Key<Struct> text(const char* name, std::string Struct::*member, const char* meaning) {
  return key_of(name, member, text_values(nullptr), "", meaning);
}
/// One line, not empty; an empty member has none.
template <class Struct, class Member>
Key<Struct> name(const char* key, Member Struct::*member, const char* meaning) {
  return key_of(key, member, name_values(static_cast<const Member*>(nullptr)), "", meaning);
}
/// An array of names or globs.
template <class Struct>
Key<Struct> names(const char* name, std::vector<std::string> Struct::*member, const char* meaning) {
  return key_of(name, member, names_values(nullptr), "", meaning);
}
/// Two names or globs.
template <class Struct>
Key<Struct> pair(const char* name, std::array<std::string, 2> Struct::*member, const char* meaning) {
  return key_of(name, member, pair_values(nullptr), "", meaning);
}
template <class Struct, class Member>
Key<Struct> vector(const char* name, Member Struct::*member, const char* unit, const char* meaning) {
  return key_of(name, member, vector_values(static_cast<const Member*>(nullptr), Vector::any), unit, meaning);
}
template <class Struct, class Member>
Key<Struct> place(const char* name, Member Struct::*member, const char* meaning) {
  return key_of(name, member, vector_values(static_cast<const Member*>(nullptr), Vector::place), "m",
                meaning);
}
template <class Struct, class Member>
Key<Struct> direction(const char* name, Member Struct::*member, const char* unit, const char* meaning) {
  return key_of(name, member, vector_values(static_cast<const Member*>(nullptr), Vector::direction), unit,
                meaning);
}
/// Two numbers. @param words name of them: "[a, b]"
template <class Struct>
Key<Struct> row(const char* name, std::array<double, 2> Struct::*member, const char* words, const char* unit,
                const char* meaning) {
  return key_of(name, member, row_values(nullptr, words), unit, meaning);
}
/// Numbers or formulas of x, y and z.
template <class Struct>
Key<Struct> field(const char* name, SceneField Struct::*member, std::size_t width, const char* words,
                  const char* unit, const char* meaning) {
  return key_of(name, member, field_values(nullptr, width, words), unit, meaning);
}
/// A word for each value. @param get,set by index of the word
[[nodiscard]] Shared word_values(std::vector<std::string> words, std::function<std::size_t(const void*)> get,
                                 std::function<void(void*, std::size_t)> set);
/// An array of some words, each a member that is true or false.
[[nodiscard]] Shared words_values(std::vector<std::string> words,
                                  std::function<bool(const void*, std::size_t)> get,
                                  std::function<void(void*, std::size_t, bool)> set);

template <class Names>
[[nodiscard]] std::vector<std::string> words_of(const Names& names) {
  std::vector<std::string> words;
  for (const auto& [word, value] : names) words.emplace_back(word);
  return words;
}

/// One of some words. @param names pairs of words and values, which outlive the key
template <class Struct, class Choice, class Names>
Key<Struct> choice(const char* name, Choice Struct::*member, const Names& names, const char* meaning) {
  const auto get = [&names](const void* value) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& one) {
      return one.second == *static_cast<const Choice*>(value);
    });
    return static_cast<std::size_t>(found - names.begin());
  };
  const auto set = [&names](void* value, std::size_t k) { *static_cast<Choice*>(value) = names[k].second; };
  return key_of(name, member, word_values(words_of(names), get, set), "", meaning);
}
/// Some of some words. @param names pairs of words and members that are true or false
template <class Struct, class Flags, class Names>
Key<Struct> words(const char* name, Flags Struct::*member, const Names& names, const char* meaning) {
  const auto get = [&names](const void* flags, std::size_t k) -> bool {
    return static_cast<const Flags*>(flags)->*names[k].second;
  };
  const auto set = [&names](void* flags, std::size_t k, bool value) {
    static_cast<Flags*>(flags)->*names[k].second = value;
  };
  return key_of(name, member, words_values(words_of(names), get, set), "", meaning);
}

/// Where a table is held: in a struct, in an optional or as one of the alternatives of a variant.
struct TableHolder {
  const TableKeys& (*keys)();
  void* (*create)(void* member);  ///< makes the struct that is read, in place of another alternative
  const void* (*held)(const void* member);  ///< null: the table is not there
  void (*drop)(void* member) = nullptr;     ///< removes it after a fault; null: it stays
  bool always = false;                      ///< it is there with its defaults if it is not given
};
[[nodiscard]] Shared table_values(TableHolder holder);

template <auto keys>
[[nodiscard]] const TableKeys& table_keys() {
  return keys().table();
}
/// @param drop a faulty one is removed
template <auto keys, class Inner>
[[nodiscard]] TableHolder in_optional(bool drop) {
  using Member = std::optional<Inner>;
  TableHolder holder{table_keys<keys>,
                     [](void* member) -> void* { return &(*static_cast<Member*>(member) = Inner()).value(); },
                     [](const void* member) -> const void* {
                       const Member& held = *static_cast<const Member*>(member);
                       return held ? &*held : nullptr;
                     }};
  if (drop) holder.drop = [](void* member) { static_cast<Member*>(member)->reset(); };
  return holder;
}

/// A table inside a table. An optional member has it if the key is given, faulty or not. @param keys function that has its
/// keys
template <auto keys, class Struct, class Inner>
Key<Struct> table(const char* name, Inner Struct::*member, const char* meaning) {
  return key_of(name, member,
                table_values({table_keys<keys>, [](void* held) { return held; },
                              [](const void* held) { return held; }, nullptr, true}),
                "", meaning);
}
template <auto keys, class Struct, class Inner>
Key<Struct> table(const char* name, std::optional<Inner> Struct::*member, const char* meaning) {
  return key_of(name, member, table_values(in_optional<keys, Inner>(false)), "", meaning);
}
/// The same; a faulty one is absent.
template <auto keys, class Struct, class Inner>
Key<Struct> faultless_table(const char* name, std::optional<Inner> Struct::*member, const char* meaning) {
  return key_of(name, member, table_values(in_optional<keys, Inner>(true)), "", meaning);
}
/// One of the alternatives of a variant, whose first one stands for a faulty table.
template <auto keys, class Inner, class Struct, class Variant>
Key<Struct> alternative(const char* name, Variant Struct::*member, const char* meaning) {
  return key_of(name, member,
                table_values({table_keys<keys>,
                              [](void* held) -> void* {
                                return &static_cast<Variant*>(held)->template emplace<Inner>();
                              },
                              [](const void* held) -> const void* {
                                return std::get_if<Inner>(static_cast<const Variant*>(held));
                              },
                              [](void* held) { *static_cast<Variant*>(held) = Variant(); }}),
                "", meaning);
}

/// A list of tables. @param listed says which entries JSON has; null: all
template <auto keys, class Inner>
class List : public Values {
 public:
  explicit List(bool (*listed)(const Inner&)) : listed_(listed) {}

  bool read(TomlTableReader& table, const std::string& key, void* member) const override {
    bool good = true;
    *static_cast<std::vector<Inner>*>(member) = table.read_tables(key, [&](TomlTableReader& entry) {
      Inner value;
      good = keys().read(entry, value) && good;
      return value;
    });
    return good;
  }
  [[nodiscard]] Json json(const void* member) const override {
    Json list = Json::array();
    for (const Inner& entry : *static_cast<const std::vector<Inner>*>(member))
      if (listed_ == nullptr || listed_(entry)) list.push_back(keys().json(entry));
    return list.empty() ? Json(nullptr) : list;
  }
  [[nodiscard]] Json schema() const override { return schema_of_array(keys().table().schema(), 0); }
  [[nodiscard]] std::string words() const override { return "a list of tables"; }
  [[nodiscard]] const TableKeys* inner() const override { return &keys().table(); }

 private:
  bool (*listed_)(const Inner&);
};
template <auto keys, class Struct, class Inner>
Key<Struct> list(const char* name, std::vector<Inner> Struct::*member, const char* meaning,
                 bool (*listed)(const Inner&) = nullptr) {
  return key_of(name, member, std::make_shared<List<keys, Inner>>(listed), "", meaning);
}

/// A table whose keys are those of the same struct.
template <auto keys, class Struct>
Key<Struct> part(const char* name, const char* meaning) {
  return {{name, "", meaning,
           table_values({table_keys<keys>, [](void* object) { return object; },
                         [](const void* object) { return object; }, nullptr, true}),
           [](void* object) { return object; }}};
}
/// A key of the struct that a member is.
template <class Struct, class Part>
Key<Struct> of(Part Struct::*part, Key<Part> key) {
  const auto inside = [part](const void* object) { return &(static_cast<const Struct*>(object)->*part); };
  const auto moved = [&](AnyKey::Condition& condition) {
    if (condition) condition = [condition, inside](const void* object) { return condition(inside(object)); };
  };
  moved(key.required_if);
  moved(key.applies);
  moved(key.written);
  Key<Struct> result{static_cast<AnyKey&&>(std::move(key))};
  result.member = [part, member = std::move(result.member)](void* object) {
    return member(&(static_cast<Struct*>(object)->*part));
  };
  return result;
}

/// A value of a form of its own, read and written by functions of the whole struct.
template <class Struct>
struct Own {
  std::string words;
  Json (*schema)();
  bool (*read)(TomlTableReader& table, const std::string& key, Struct& object);
  Json (*json)(const Struct& object);
  const TableKeys& (*inner)() = nullptr;  ///< keys of a table that is one of its forms
};

template <class Struct>
class OwnValues : public Values {
 public:
  explicit OwnValues(Own<Struct> own) : own_(std::move(own)) {}

  bool read(TomlTableReader& table, const std::string& key, void* member) const override {
    return own_.read(table, key, *static_cast<Struct*>(member));
  }
  [[nodiscard]] Json json(const void* member) const override {
    return own_.json(*static_cast<const Struct*>(member));
  }
  [[nodiscard]] Json schema() const override { return own_.schema(); }
  [[nodiscard]] std::string words() const override { return own_.words; }
  [[nodiscard]] const TableKeys* inner() const override {
    return own_.inner == nullptr ? nullptr : &own_.inner();
  }

 private:
  Own<Struct> own_;
};

template <class Struct>
Key<Struct> own(const char* name, Own<Struct> form, const char* unit, const char* meaning) {
  return {{name, unit, meaning, std::make_shared<OwnValues<Struct>>(std::move(form)),
           [](void* object) { return object; }}};
}

/// A finding of the reader for a key, for JSON. @param json null if there is nothing
template <class Struct>
Key<Struct> found(const char* name, Json (*json)(const Struct& object)) {
  return own<Struct>(name, {"", nullptr, nullptr, json}, "", "").found_by_reader();
}

/// Rows that begin with a time, or a file with them. @param width numbers in a row. @param words name of a row
template <class Struct>
struct History {
  std::size_t width;
  const char* words;
  void (*set)(Struct& object, HistoryRows rows);
  Json (*json)(const Struct& object);  ///< null without a history
};
[[nodiscard]] std::string history_words(const char* row);
[[nodiscard]] Json history_schema(std::size_t width);
[[nodiscard]] Json json_of_places(const std::vector<Vector3>& places);
/// Of a history from a file: the file.
[[nodiscard]] Json json_of_file(const SceneRecord& file);

template <class Struct>
class HistoryValues : public Values {
 public:
  explicit HistoryValues(History<Struct> history) : history_(history) {}

  bool read(TomlTableReader& table, const std::string& key, void* member) const override {
    auto rows = read_history(table, key, history_.width, history_.words);
    if (rows) history_.set(*static_cast<Struct*>(member), std::move(*rows));
    return rows.has_value();
  }
  [[nodiscard]] Json json(const void* member) const override {
    return history_.json(*static_cast<const Struct*>(member));
  }
  [[nodiscard]] Json schema() const override { return history_schema(history_.width); }
  [[nodiscard]] std::string words() const override { return history_words(history_.words); }

 private:
  History<Struct> history_;
};

/// Rows of a time and three components, or the file that they come from.
template <class Rows>
[[nodiscard]] Json json_of_rows(const std::optional<SceneRecord>& file, const Rows& history) {
  if (file) return json_of_file(*file);
  if (history.empty()) return nullptr;
  Json rows = Json::array();
  for (const auto& [time, value] : history) rows.push_back({time, value.x(), value.y(), value.z()});
  return rows;
}

template <class Struct>
Key<Struct> history(const char* name, History<Struct> form, const char* unit, const char* meaning) {
  return {{name, unit, meaning, std::make_shared<HistoryValues<Struct>>(form),
           [](void* object) { return object; }}};
}

template <class Struct>
[[nodiscard]] std::vector<Key<Struct>> joined(std::vector<Key<Struct>> keys, std::vector<Key<Struct>> more) {
  keys.insert(keys.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return keys;
}

}  // namespace ashlar::keys

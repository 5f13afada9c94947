// A key of a table of a scene as a user knows it: its name, what it holds, its unit, default and meaning. Tables of keys
// are in table_keys.hpp, what keys hold is in values.hpp.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/toml/toml_table_reader.hpp"

namespace ashlar::keys {

using Json = nlohmann::ordered_json;

class TableKeys;

/// The values that a key may hold: they are read, written and described here. Functions have the address of the member that holds the
/// value; its type belongs to the class that is derived.
class Values {
 public:
  Values() = default;
  Values(const Values&) = delete;
  Values& operator=(const Values&) = delete;
  virtual ~Values() = default;

  /// Leaves the member unchanged if the key is absent or faulty. @return true if a valid value was read
  virtual bool read(TomlTableReader& table, const std::string& key, void* member) const = 0;
  /// @return null if there is no value
  [[nodiscard]] virtual Json json(const void* member) const = 0;
  /// JSON schema of the value.
  [[nodiscard]] virtual Json schema() const = 0;
  /// The accepted values in the words of messages: "a number > 0".
  [[nodiscard]] virtual std::string words() const = 0;
  /// Of a value that is missing or faulty: makes it one to which no later check applies, where there is one (not finite).
  virtual void spoil(void* member) const { (void)member; }
  /// The keys of a table or of a list of tables; null for other values.
  [[nodiscard]] virtual const TableKeys* inner() const { return nullptr; }
};

/// A key whose table is read into some struct.
struct AnyKey {
  using Condition = std::function<bool(const void* object)>;

  std::string name, unit, meaning;
  std::shared_ptr<const Values> values;
  std::function<void*(void* object)> member;

  std::string absent = {};  ///< default in words; empty: the value of a struct that was not read
  bool required = false;
  Condition required_if = nullptr;                 ///< required where it holds
  std::vector<const char*> required_without = {};  ///< required if none of these is given
  std::vector<const char*> excluded_by = {};       ///< keys beside which it is refused
  Condition applies = nullptr;                     ///< empty: always
  std::string needs = {};                          ///< what it needs to apply, for a message
  Condition written = nullptr;                     ///< in JSON; empty: always
  bool omit_empty = false;                         ///< an empty list or text is not written
  bool brief = false;                              ///< the reference has the keys of its table elsewhere
  bool found = false;  ///< in JSON alone: what the reader found, no key of a scene

  [[nodiscard]] const void* member_of(const void* object) const {
    return member(const_cast<void*>(object));  // the function only computes an address
  }
};

/// A key of a table that is read into a Struct. The functions return the key, so that a declaration is one expression.
template <class Struct>
struct Key : AnyKey {
  using Test = bool (*)(const Struct&);

  Key required_always() && {
    required = true;
    return std::move(*this);
  }
  Key required_where(Test test) && {
    required_if = condition(test);
    absent = "required";
    return std::move(*this);
  }
  Key required_unless_given(std::vector<const char*> others) && {
    required_without = std::move(others);
    absent = "required";
    return std::move(*this);
  }
  Key not_beside(std::vector<const char*> others) && {
    excluded_by = std::move(others);
    return std::move(*this);
  }
  /// @param words what it needs, for a message: "a bolt with grout"
  Key only_if(Test test, const char* words) && {
    applies = condition(test);
    needs = words;
    return std::move(*this);
  }
  /// @param words the default in the reference
  Key otherwise(const char* words) && {
    absent = words;
    return std::move(*this);
  }
  /// Says where JSON has the key.
  Key written_if(Test test) && {
    written = condition(test);
    return std::move(*this);
  }
  Key not_written() && {
    written = [](const void*) { return false; };
    return std::move(*this);
  }
  Key unless_empty() && {
    omit_empty = true;
    return std::move(*this);
  }
  Key described_elsewhere() && {
    brief = true;
    return std::move(*this);
  }
  Key found_by_reader() && {
    found = true;
    return std::move(*this);
  }

 private:
  static Condition condition(Test test) {
    return [test](const void* object) { return test(*static_cast<const Struct*>(object)); };
  }
};

template <class Struct, class Member>
[[nodiscard]] Key<Struct> key_of(const char* name, Member Struct::*member,
                                 std::shared_ptr<const Values> values, const char* unit,
                                 const char* meaning) {
  return {{name, unit, meaning, std::move(values),
           [member](void* object) -> void* { return &(static_cast<Struct*>(object)->*member); }}};
}

}  // namespace ashlar::keys

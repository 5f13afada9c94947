// Base of the classes of values that a key holds, by the type of the member.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/scene/keys/values.hpp"

namespace ashlar::keys {

/// Values held by a Member.
template <class Member>
class ValuesOf : public Values {
 public:
  bool read(TomlTableReader& table, const std::string& key, void* member) const final {
    return read_value(table, key, *static_cast<Member*>(member));
  }
  [[nodiscard]] Json json(const void* member) const final {
    return json_of(*static_cast<const Member*>(member));
  }

 protected:
  virtual bool read_value(TomlTableReader& table, const std::string& key, Member& member) const = 0;
  [[nodiscard]] virtual Json json_of(const Member& member) const = 0;
};

template <class Value>
Json json_or_null(const Value& value) {
  return value;
}
template <class Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class Kind, class... Arguments>
Shared shared(Arguments&&... arguments) {
  return std::make_shared<Kind>(std::forward<Arguments>(arguments)...);
}

}  // namespace ashlar::keys

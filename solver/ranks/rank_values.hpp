// Plain values in the messages of ranks.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "solver/ranks/ranks.hpp"

namespace ashlar {

template <class Value>
[[nodiscard]] Bytes bytes_of_values(std::span<const Value> values) {
  static_assert(std::is_trivially_copyable_v<Value>);
  const auto bytes = std::as_bytes(values);
  return {bytes.begin(), bytes.end()};
}

template <class Value>
[[nodiscard]] std::vector<Value> values_of_bytes(const Bytes& bytes) {
  static_assert(std::is_trivially_copyable_v<Value>);
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return values;
}

}  // namespace ashlar

// Fields of a frame by name, checked for the required type and number of components.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// The values of the array of that name, T double or std::int32_t; null if there is none.
/// @throws std::runtime_error if it has another type or another number of components
template <class T>
const std::vector<T>* find_values(const std::vector<DataArray>& arrays, std::string_view name,
                                  int components) {
  const auto array =
      std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& known) { return known.name == name; });
  if (array == arrays.end()) return nullptr;
  const auto* values = std::get_if<std::vector<T>>(&array->values);
  if (values == nullptr) {
    throw std::runtime_error(fmt::format("array '{}' has the wrong type, {} is needed", name,
                                         std::is_same_v<T, double> ? "Float64" : "Int32"));
  }
  if (array->components != components) {
    throw std::runtime_error(
        fmt::format("array '{}' has {} components, {} needed", name, array->components, components));
  }
  return values;
}

/// The same for a required array. @throws std::runtime_error also if it is missing
template <class T>
const std::vector<T>& required_values(const std::vector<DataArray>& arrays, std::string_view name,
                                      int components) {
  const std::vector<T>* values = find_values<T>(arrays, name, components);
  if (values == nullptr) throw std::runtime_error(fmt::format("a frame has no array '{}'", name));
  return *values;
}

}  // namespace ashlar

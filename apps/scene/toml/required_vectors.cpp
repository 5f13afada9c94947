#include "apps/scene/toml/required_vectors.hpp"

#include <fmt/format.h>

#include <limits>

namespace ashlar {

Vector3 required_vector(TomlTableReader& table, const char* key) {
  Vector3 result = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  table.require(key);
  table.read_vector(key, result);
  return result;
}

Vector3 required_place(TomlTableReader& table, const char* key) {
  Vector3 result = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  table.require(key);
  table.read_place(key, result);
  return result;
}

Vector3 required_direction(TomlTableReader& table, const char* key) {
  Vector3 result = required_vector(table, key);
  // The length may underflow for a valid direction; the largest component does not.
  if (result.allFinite() && result.cwiseAbs().maxCoeff() == 0.0) {
    table.error_at_value(
        key, fmt::format("{} has no direction ([0, 0, 0]), a vector other than zero is needed", key));
    result.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

}  // namespace ashlar

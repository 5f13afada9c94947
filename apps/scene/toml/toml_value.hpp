// From a node of a TOML document to a number, a word or a row: its type, range and finiteness are checked, and faults
// are reported at its place.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/toml/number_ranges.hpp"
#include "apps/scene/toml/toml_reading.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// The value of a key, or an entry of its array. Functions with a result return empty after a fault.
class TomlValue {
 public:
  /// @param reading,node,key must outlive this
  TomlValue(TomlReading& reading, const toml::node& node, std::string_view key)
      : reading_(reading), node_(node), key_(key) {}

  /// Reports a wrong type. @param words description of the allowed values. @param hint additional text
  void wrong_type(std::string_view words, std::string_view hint = "") const;
  /// @param words description of the allowed values
  [[nodiscard]] std::optional<double> finite_number(std::string_view words) const;
  [[nodiscard]] std::optional<double> number(const NumberRange& range) const;
  /// @param other words for other values of the key: " or ..."
  [[nodiscard]] std::optional<int> whole_number(int low, int high, std::string_view other = {}) const;
  /// Index of the word.
  [[nodiscard]] std::optional<std::size_t> word(const std::vector<std::string>& words) const;
  /// Finite numbers. @param words description of the row
  [[nodiscard]] std::optional<std::vector<double>> row(std::size_t width, std::string_view words) const;
  /// Reports the first coordinate that is too large, m. @return true if there is none
  [[nodiscard]] bool holds_place(const Vector3& place) const;

 private:
  TomlReading& reading_;
  const toml::node& node_;
  std::string_view key_;
};

/// "a whole number from 0 to 8".
[[nodiscard]] std::string whole_number_words(int low, int high);

}  // namespace ashlar

// From a node of a TOML document to a number, a word or a row: its type, range and finiteness are checked, and what is
// wrong with it is reported at its place.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/number_ranges.hpp"
#include "apps/scene/toml_reading.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// The value of a key, or an entry of one that is an array. What has a result returns none after a fault.
class TomlValue {
 public:
  /// @param reading,node,key outlive this
  TomlValue(TomlReading& reading, const toml::node& node, std::string_view key)
      : reading_(reading), node_(node), key_(key) {}

  /// Reports that it is of another type. @param words for what is needed @param hint what else to say of it
  void wrong_type(std::string_view words, std::string_view hint = "") const;
  /// @param words for what is needed
  [[nodiscard]] std::optional<double> finite_number(std::string_view words) const;
  [[nodiscard]] std::optional<double> number(const NumberRange& range) const;
  [[nodiscard]] std::optional<int> whole_number(int low, int high) const;
  /// The index of the word that it is.
  [[nodiscard]] std::optional<std::size_t> word(const std::vector<std::string>& words) const;
  /// Finite numbers. @param words for the row
  [[nodiscard]] std::optional<std::vector<double>> row(std::size_t width, std::string_view words) const;
  /// Reports the first coordinate that is too large, m. @return whether there is none
  [[nodiscard]] bool holds_place(const Vector3& place) const;

 private:
  TomlReading& reading_;
  const toml::node& node_;
  std::string_view key_;
};

/// "a whole number from 0 to 8".
[[nodiscard]] std::string whole_number_words(int low, int high);

}  // namespace ashlar

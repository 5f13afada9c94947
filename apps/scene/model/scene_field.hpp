// Quantities of a scene that may vary from place to place.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Components by numbers, or by formulas of x, y and z (m, as blocks are placed).
struct SceneField {
  std::vector<std::variant<double, std::string>> written;  ///< by component, for a reader of the scene
  /// @throws std::runtime_error where a formula has no finite value
  std::function<std::vector<double>(const Vector3&)> at;

  [[nodiscard]] bool given() const { return !written.empty(); }
};

}  // namespace ashlar

// [initial_stress]: the stress of the ground before anything moves (scene.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene_field.hpp"

namespace ashlar {

/// Either six components, or the weight of what lies above with a ratio of horizontal to vertical stress.
struct SceneInitialStress {
  SceneField stress;  ///< xx, yy, zz, xy, yz, zx; Pa, tension positive
  std::optional<double> k0;
  double surface = 0.0;  ///< m, height along z (against gravity) where the vertical stress begins
  std::optional<double> unit_weight;        ///< N/m^3; empty: density of the block times gravity
  std::vector<std::string> blocks = {"*"};  ///< names or globs

  [[nodiscard]] bool given() const { return stress.given() || k0.has_value(); }
};

}  // namespace ashlar

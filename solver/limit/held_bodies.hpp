// A rigid model with some of its bodies held where they are.
#pragma once

#include <vector>

#include "solver/limit/rigid_model.hpp"

namespace ashlar {

struct HeldModel {
  RigidModel model;           ///< bodies in their order, without the held ones
  std::vector<bool> reduced;  ///< by point of it, as of the whole model
};

/// @param free by body. @param reduced by point of the model: its strength is divided
[[nodiscard]] HeldModel with_held_bodies(const RigidModel& model, const std::vector<bool>& free,
                                         const std::vector<bool>& reduced);

}  // namespace ashlar

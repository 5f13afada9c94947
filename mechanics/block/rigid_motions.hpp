// Rigid motions of a block that its supports allow, in terms a user can act on.
#pragma once

#include <string>
#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Velocity field  translation + rotation x (X - centroid) of an undeformed block.
struct RigidMotion {
  Vector3 translation = Vector3::Zero();  ///< of the centroid
  Vector3 rotation = Vector3::Zero();  ///< about it, 1/m: rotation by 1 moves points one block size away by 1
};

/// A basis of the admissible rigid motions, translations first, each as simple as the others allow: 6 for a free
/// block, 0 for one that is fixed by its supports.
[[nodiscard]] std::vector<RigidMotion> admissible_rigid_motions(const BlockModel& block);

/// "translation along [1, 0, 0]", "rotation about [0, 0, 1] through [2, 0, 0.5]", "any rigid motion".
[[nodiscard]] std::string describe(const std::vector<RigidMotion>& motions, const BlockModel& block);

}  // namespace ashlar

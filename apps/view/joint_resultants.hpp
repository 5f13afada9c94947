// What the contacts of two blocks come to: one force at one place, as a force chain and a thrust line show it.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/results/vtu_writer.hpp"

namespace ashlar {

/// Of a pair of blocks with closed contact points.
struct JointResultant {
  std::int32_t a, b;  ///< numbers of the blocks
  Vector3 force;      ///< N, on a; b bears the opposite
  Vector3
      place;  ///< m, centre of the compression: mean place of the points, weighed with their normal forces where
              ///< they press. Where none presses, with the sizes of their forces
  std::int32_t state;  ///< of the points that bear most: 1 locked, 2 sliding
};

/// @param contacts a frame of contacts.pvd. @return by a, then b; pairs whose forces are all zero are left out
/// @throws std::runtime_error if an array is missing or of another kind
[[nodiscard]] std::vector<JointResultant> joint_resultants(const UnstructuredGrid& contacts);

}  // namespace ashlar

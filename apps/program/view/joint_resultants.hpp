// Resultant of the contacts of two blocks: one force at one place, for force chains and thrust lines.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// Resultant of a pair of blocks with closed contact points.
struct FrameResultant {
  std::int32_t a, b;  ///< numbers of the blocks
  Vector3 force;      ///< N, on a; its opposite acts on b
  Vector3
      place;  ///< m, centre of compression: mean place of the points, weighted with their compressive normal
              ///< forces; without compression, weighted with the magnitudes of their forces
  std::int32_t state;  ///< of the points with most of the force: 1 locked, 2 sliding
};

/// @param contacts a frame of contacts.pvd. @return by a, then b; pairs without force are omitted
/// @throws std::runtime_error if an array is missing or of another kind
[[nodiscard]] std::vector<FrameResultant> joint_resultants(const UnstructuredGrid& contacts);

}  // namespace ashlar

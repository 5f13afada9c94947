// Blocks as placed, for water and boundaries of the ground, which depend on faces alone.
#pragma once

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

struct GroundBlock {
  const Polyhedron* solid = nullptr;  ///< as placed, m; null: unknown, the block has no faces
  bool fixed = false;                 ///< true: no load acts on it, and it ends at no boundary
  bool present = true;                ///< false: it has neither free faces nor joints
};

}  // namespace ashlar

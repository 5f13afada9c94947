// Removability and motion of one block: the block theory of Goodman and Shi, Block Theory and Its Application to Rock
// Engineering (1985).
//
// A block restrained by faces with outward normals n_i can move along s if n_i . s <= 0 for all of them: these s are
// the joint pyramid. A block is removable if the pyramid has a direction other than zero (their theorem, in terms of
// moves). Under a force r the block moves along the direction of the pyramid closest to r: r itself (falling, or
// lifting), the projection of r on one face, or on the line of two faces (sliding). The rest r - s is the reaction of
// the faces: r - s = sum of l_i n_i with l_i >= 0. All of this is decided by the signs of integers.
#pragma once

#include <array>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

enum class BlockMode {
  not_removable,   ///< the pyramid is empty: neighbours restrain the block under any force
  stable,          ///< removable, but the force presses it against its faces
  falling,         ///< along the force, away from all faces or along them without pressure
  sliding_on_one,  ///< along one face
  sliding_on_two,  ///< along the line of two faces
};

/// "not removable", "stable", "falling", "sliding on one face", "sliding on two faces".
[[nodiscard]] const char* to_string(BlockMode mode);

struct KeyBlock {
  bool finite = false;     ///< no direction points away from all of its faces, restraining or free
  bool removable = false;  ///< the joint pyramid is not empty
  BlockMode mode = BlockMode::not_removable;
  std::array<int, 2> faces = {-1, -1};  ///< faces of sliding, as numbered by the caller
  Vector3 direction = Vector3::Zero();  ///< of motion, unit, rounded; zero if it does not move
  std::array<double, 2> pressure = {};  ///< normal forces on `faces` for a force of length 1, rounded
  double thrust = 0.0;                  ///< force along the direction, for a force of length 1, rounded
};

}  // namespace ashlar

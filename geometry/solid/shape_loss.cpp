#include "geometry/solid/shape_loss.hpp"

#include <algorithm>

namespace ashlar {

bool is_lost_in_rounding(const Polyhedron& solid) {
  constexpr std::size_t least_faces = 4;    // of a tetrahedron
  constexpr std::size_t least_corners = 3;  // of a triangle
  const auto has_outline = [](const PolyhedronFace& face) {
    return !face.loops.empty() && face.loops.front().size() >= least_corners;
  };
  return solid.faces().size() < least_faces ||
         !std::all_of(solid.faces().begin(), solid.faces().end(), has_outline);
}

}  // namespace ashlar

// The solids of a scene: each block's shape built in its own coordinates and placed by scale, rotate,
// translate.
#pragma once

#include <optional>
#include <vector>

#include "apps/diagnostics.hpp"
#include "apps/scene.hpp"
#include "geometry/polyhedron.hpp"

namespace ashlar {

/// Builds and places the shape of every block, in the scene's order. Faces are merged before placing, where
/// they are exactly flat, so a rotated box still has six. Without rotate a box keeps exactly its corners
/// (plus translate); turns by multiples of 90 degrees about a coordinate axis have an exact rotation matrix.
/// A shape that bounds no solid is reported at its key, a mesh with its file and the faulty elements, and
/// leaves an empty entry.
[[nodiscard]] std::vector<std::optional<Polyhedron>> build_solids(const Scene& scene,
                                                                  Diagnostics& diagnostics);

/// How far a plane or point of the scene may be off the solid it is meant for: rotations round, and users
/// round numbers.
struct PlacementTolerance {
  double relative = 1e-6;  ///< in parts of the diagonal of the solid's bounding box
};

/// The distance in m that a tolerance allows on a solid.
[[nodiscard]] double allowed_offset(const Polyhedron& solid, const PlacementTolerance& tolerance = {});

/// Faces of a placed solid that lie in a plane, increasing; both directions of the plane's normal are the
/// same.
[[nodiscard]] std::vector<int> find_faces_in_plane(const Polyhedron& solid, const ScenePlane& plane,
                                                   const PlacementTolerance& tolerance = {});

}  // namespace ashlar

// Faces selected by a user with a plane, and quadrature over them.
#pragma once

#include <variant>
#include <vector>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// A plane as given by the user; length and sign of its normal are irrelevant.
struct Plane {
  Vector3 point = Vector3::Zero();    ///< m
  Vector3 normal = Vector3::UnitZ();  ///< not zero
};

/// Faces by their indices in the solid.
struct FaceList {
  std::vector<int> faces;
};

/// Place of a support or load: all faces in a plane, one material point, or faces by index. Reference coordinates, m.
using BlockPlace = std::variant<Plane, Vector3, FaceList>;

/// Largest distance of a plane or point from the solid it refers to, as a share of the diagonal of the solid's box:
/// users write decimals, and a rotated block's corners are rounded.
inline constexpr double placement_tolerance = 1e-6;

/// The same distance in m.
[[nodiscard]] double allowed_offset(const Polyhedron& solid);

/// Indices of the faces all of whose corners lie in the plane, increasing. Empty if there is none.
/// @throws std::invalid_argument if the normal is zero or not finite
[[nodiscard]] std::vector<int> faces_in_plane(const Polyhedron& solid, const Plane& plane);

/// Faces of a place, none for a point. @throws std::invalid_argument as faces_in_plane, or if an index is not that of
/// a face
[[nodiscard]] std::vector<int> faces_at(const Polyhedron& solid, const BlockPlace& place);

/// Points (m) with weights (m^2) that integrate polynomials of a degree exactly over some faces.
struct SurfaceRule {
  std::vector<Vector3> points;
  std::vector<double> weights;
};
[[nodiscard]] SurfaceRule surface_rule(const Polyhedron& solid, const std::vector<int>& faces, int degree);

}  // namespace ashlar

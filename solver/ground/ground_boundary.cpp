#include "solver/ground/ground_boundary.hpp"

#include <cmath>

namespace ashlar {
namespace {

/// Cosine of a right angle between directions that are written in decimals.
constexpr double right_angle_cosine = 1e-9;

}  // namespace

std::array<bool, 3> held_components(const Vector3& normal, const Vector3& gravity) {
  const Vector3 unit = normal.normalized();
  std::array<bool, 3> held = {true, true, true};
  if (gravity.isZero(0.0) || std::abs(unit.dot(gravity.normalized())) > right_angle_cosine) return held;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(unit[axis]) < 1.0 - right_angle_cosine) continue;
    held = {axis == 0, axis == 1, axis == 2};
  }
  return held;
}

std::optional<std::size_t> base_of_side(const std::vector<GroundBoundary>& boundaries, std::size_t side) {
  std::optional<std::size_t> base;
  const Vector3 normal = boundaries[side].plane.normal.normalized();
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const GroundBoundary& other = boundaries[i];
    if (other.kind != GroundBoundary::Kind::quiet) continue;
    if (std::abs(other.plane.normal.normalized().dot(normal)) > right_angle_cosine) continue;
    if (!base || (boundaries[*base].wave.empty() && !other.wave.empty())) base = i;
  }
  return base;
}

std::optional<QuietFaces> quiet_faces_of(const GroundBoundary& boundary, const SideColumn& column,
                                         const Polyhedron& solid, const Material& material,
                                         const Vector3& gravity) {
  const std::vector<int> faces = outer_faces(solid, boundary.plane);
  if (faces.empty()) return std::nullopt;
  return QuietFaces{.where = FaceList{faces},
                    .components = held_components(boundary.plane.normal, gravity),
                    .driving = column.column != nullptr
                                   ? column_loads(column, solid, material, faces)
                                   : wave_loads(solid, faces, material, components_of(boundary.wave))};
}

}  // namespace ashlar

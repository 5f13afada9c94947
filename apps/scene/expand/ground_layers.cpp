#include "apps/scene/expand/ground_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mechanics/supports/quiet_faces.hpp"

namespace ashlar {
namespace {

/// A face beside the column.
struct SideFace {
  double bottom = std::numeric_limits<double>::infinity();  ///< m, above the base
  double top = -std::numeric_limits<double>::infinity();
  double area = 0.0;  ///< m^2
  std::size_t block = 0;
};

SideFace side_face(const Polyhedron& solid, int face, const Vector3& up, const Vector3& origin) {
  SideFace result;
  for (const int corner : solid.faces()[static_cast<std::size_t>(face)].loops.front()) {
    const double height = up.dot(solid.mesh().points[static_cast<std::size_t>(corner)] - origin);
    result.bottom = std::min(result.bottom, height);
    result.top = std::max(result.top, height);
  }
  const std::vector<double> weights = surface_rule(solid, {face}, 0).weights;
  result.area = std::accumulate(weights.begin(), weights.end(), 0.0);
  return result;
}

/// Heights at which faces begin or end; those within a tolerance are one.
std::vector<double> limits_of(const std::vector<SideFace>& faces, double tolerance) {
  std::vector<double> all;
  for (const SideFace& face : faces) all.insert(all.end(), {face.bottom, face.top});
  std::sort(all.begin(), all.end());
  std::vector<double> limits;
  for (const double height : all)
    if (limits.empty() || height > limits.back() + tolerance) limits.push_back(height);
  return limits;
}

}  // namespace

std::optional<std::size_t> base_of_side(const Scene& scene, std::size_t side) {
  constexpr double across = 1e-9;  // cosine of a right angle, as written in decimals
  std::optional<std::size_t> base;
  const Vector3 normal = scene.boundary[side].plane.normal.normalized();
  for (std::size_t i = 0; i < scene.boundary.size(); ++i) {
    const SceneBoundary& other = scene.boundary[i];
    if (other.kind != SceneBoundary::Kind::quiet) continue;
    if (std::abs(other.plane.normal.normalized().dot(normal)) > across) continue;
    if (!base || (scene.boundary[*base].wave.empty() && !other.wave.empty())) base = i;
  }
  return base;
}

SideLayers layers_beside(const Scene& scene, std::size_t side, std::size_t base,
                         const std::vector<const Polyhedron*>& solids) {
  const ScenePlane& plane = scene.boundary[side].plane;
  const Vector3 up = -scene.boundary[base].plane.normal.normalized();
  std::vector<SideFace> faces;
  double tolerance = 0.0;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (solids[k] == nullptr || scene.block[k].fixed || (!scene.absent.empty() && scene.absent[k])) continue;
    for (const int face : outer_faces(*solids[k], {plane.point, plane.normal})) {
      faces.push_back(side_face(*solids[k], face, up, scene.boundary[base].plane.point));
      faces.back().block = k;
      tolerance = std::max(tolerance, allowed_offset(*solids[k]));
    }
  }
  SideLayers result;
  const std::vector<double> limits = limits_of(faces, tolerance);
  if (limits.empty() || std::abs(limits.front()) > tolerance) {
    result.fault = limits.empty() ? "no block is beside it"
                                  : fmt::format("its faces begin {:.3g} m above the base", limits.front());
    return result;
  }
  if (limits.size() == 1) {
    result.fault = fmt::format(
        "its faces are lower than {:.3g} m, to which the largest block beside it is known", tolerance);
    return result;
  }
  for (std::size_t n = 0; n + 1 < limits.size(); ++n) {
    const double middle = 0.5 * (limits[n] + limits[n + 1]);
    const SideFace* largest = nullptr;
    for (const SideFace& face : faces)
      if (face.bottom < middle && middle < face.top && (largest == nullptr || face.area > largest->area))
        largest = &face;
    if (largest == nullptr)
      return {
          {},
          fmt::format("no face is between {:.6g} m and {:.6g} m above the base", limits[n], limits[n + 1])};
    result.layers.push_back({limits[n], limits[n + 1], largest->block});
  }
  return result;
}

}  // namespace ashlar

#include "solver/ground/side_layers.hpp"

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

SideLayers layers_beside(const Plane& side, const Plane& base, const std::vector<GroundBlock>& blocks) {
  using Fault = SideLayersFault::Kind;
  const Vector3 up = -base.normal.normalized();
  std::vector<SideFace> faces;
  double tolerance = 0.0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (blocks[k].solid == nullptr || blocks[k].fixed || !blocks[k].present) continue;
    const Polyhedron& solid = *blocks[k].solid;
    for (const int face : outer_faces(solid, side)) {
      faces.push_back(side_face(solid, face, up, base.point));
      faces.back().block = k;
      tolerance = std::max(tolerance, allowed_offset(solid));
    }
  }
  const std::vector<double> limits = limits_of(faces, tolerance);
  if (limits.empty()) return {{}, SideLayersFault{Fault::no_face}};
  if (std::abs(limits.front()) > tolerance) return {{}, SideLayersFault{Fault::above_base, limits.front()}};
  if (limits.size() == 1) return {{}, SideLayersFault{Fault::too_low, tolerance}};
  SideLayers result;
  for (std::size_t n = 0; n + 1 < limits.size(); ++n) {
    const double middle = 0.5 * (limits[n] + limits[n + 1]);
    const SideFace* largest = nullptr;
    for (const SideFace& face : faces)
      if (face.bottom < middle && middle < face.top && (largest == nullptr || face.area > largest->area))
        largest = &face;
    if (largest == nullptr) return {{}, SideLayersFault{Fault::gap, limits[n], limits[n + 1]}};
    result.layers.push_back({limits[n], limits[n + 1], largest->block});
  }
  return result;
}

}  // namespace ashlar

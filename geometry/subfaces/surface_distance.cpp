#include "geometry/subfaces/surface_distance.hpp"

#include <algorithm>
#include <limits>

namespace ashlar {
namespace {

/// Width of the slab across a direction between two surfaces: a lower bound of their distance for any curvature.
/// Negative if the direction does not separate them.
double slab_between(const PlacedSurface& a, const PlacedSurface& b, const Vector3& direction) {
  const auto extreme = [&](const PlacedSurface& surface, double sign) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3& point : surface.points()) most = std::max(most, sign * direction.dot(point));
    return most;
  };
  const double size = std::max(a.box().high.cwiseAbs().maxCoeff(), b.box().high.cwiseAbs().maxCoeff()) +
                      std::max(a.box().low.cwiseAbs().maxCoeff(), b.box().low.cwiseAbs().maxCoeff());
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * size;
  return -extreme(b, -1.0) - extreme(a, 1.0) - a.largest_chord_bound() - b.largest_chord_bound() - rounding;
}

}  // namespace

double least_distance(const PlacedSurface& a, const PlacedSurface& b) {
  const Vector3 between = 0.5 * (b.box().low + b.box().high - a.box().low - a.box().high);
  double bound = (a.box().low - b.box().high).cwiseMax(b.box().low - a.box().high).cwiseMax(0.0).norm();
  if (between.norm() > 0.0) bound = std::max(bound, slab_between(a, b, between.normalized()));
  for (int cell = 0; cell < static_cast<int>(a.surface().cells.size()); ++cell)
    bound = std::max(bound, slab_between(a, b, a.normal(cell)));
  for (int cell = 0; cell < static_cast<int>(b.surface().cells.size()); ++cell)
    bound = std::max(bound, slab_between(a, b, -b.normal(cell)));
  return bound;
}

}  // namespace ashlar

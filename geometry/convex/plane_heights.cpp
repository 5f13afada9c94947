#include "geometry/convex/plane_heights.hpp"

#include <algorithm>
#include <limits>

namespace ashlar {

PlaneHeights::PlaneHeights(const ConvexShape& planes, const ConvexShape& corners)
    : planes_(&planes), corners_(&corners), width_(extra + corners.corners().size()) {
  const Vector3 ahead = corners.high() - planes.low(), behind = planes.high() - corners.low();
  // Five roundings, each of less than 2^-52 of the sum.
  reach_ = ahead.cwiseAbs().cwiseMax(behind.cwiseAbs()).sum() * (1.0 + 0x1p-40);
}

void PlaneHeights::compute(int f) {
  if (values_.empty()) values_.resize(static_cast<std::size_t>(planes_->facet_count()) * width_);
  const DirectionNumbers& n = planes_->normal_numbers(f);
  const double nx = n.tracked.x.value, ny = n.tracked.y.value, nz = n.tracked.z.value;
  const Vector3& x = planes_->corners()[planes_->facet(f)[0]];
  const double x0 = x[0], x1 = x[1], x2 = x[2];
  double* const row = values_.data() + static_cast<std::size_t>(f) * width_;
  double* value = row + extra;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vector3& y : corners_->corners()) {
    const double height = nx * (y[0] - x0) + ny * (y[1] - x1) + nz * (y[2] - x2);  // bound: quick_sign
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    *value++ = height;
  }
  row[0] = reach_ * n.bound;
  row[1] =
      3.0 * row[0];  // the bounds of both, and the rounding of the difference, which is less than one of them
  row[2] = lowest;
  row[3] = highest;
}

}  // namespace ashlar

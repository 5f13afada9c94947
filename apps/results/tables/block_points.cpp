#include "apps/results/tables/block_points.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "mechanics/supports/face_selection.hpp"

namespace ashlar {

std::shared_ptr<const ClosestPointFinder> BlockPoints::finder_of(int number, const Polyhedron& solid) const {
  const std::lock_guard lock(access_);
  std::shared_ptr<const ClosestPointFinder>& finder = finders_[number];
  if (!finder) finder = std::make_shared<const ClosestPointFinder>(solid);
  return finder;
}

void BlockPoints::require(int number, const BlockModel& block, const std::vector<Vector3>& points,
                          const Vector3& origin) const {
  const std::shared_ptr<const ClosestPointFinder> finder = finder_of(number, block.solid());
  const double allowed = allowed_offset(block.solid());
  for (const Vector3& point : points) {
    const auto refuse = [&](const std::string& why) {
      const Vector3 given = origin + point;
      throw std::domain_error(fmt::format("point ({:.9g}, {:.9g}, {:.9g}) is not of block {}: {}", given.x(),
                                          given.y(), given.z(), block.name(), why));
    };
    if (!point.allFinite()) refuse("finite coordinates are needed");
    const ClosestPoint nearest = finder->find_any(point);
    if (nearest.place != PointPlace::outside || nearest.squared_distance <= allowed * allowed) continue;
    refuse(fmt::format(
        "it is {:.3g} m outside, a point of the placed, undeformed block is needed (within {:.2g} m)",
        std::sqrt(nearest.squared_distance), allowed));
  }
}

}  // namespace ashlar

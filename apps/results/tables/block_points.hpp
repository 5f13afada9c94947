// Check of points supplied by callers: outside of its block a polynomial is defined, but has no meaning.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "geometry/any_solid/closest_point.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Treatment of points outside the block.
enum class OutsidePoints { refused, extrapolated };

/// For the blocks of a run, whose placed, undeformed solids are constant. May be called from many threads.
class BlockPoints {
 public:
  /// Points of a block are inside, on its surface, or within allowed_offset of it
  /// (mechanics/supports/face_selection.hpp), as the points of a scene: coordinates of a rotated block are rounded.
  /// @param number of the block in the run. @param points m, of the placed, undeformed block
  /// @param origin Scene::origin, for the message
  /// @throws std::domain_error with the block, the first outside point and its distance
  void require(int number, const BlockModel& block, const std::vector<Vector3>& points,
               const Vector3& origin = Vector3::Zero()) const;

 private:
  [[nodiscard]] std::shared_ptr<const ClosestPointFinder> finder_of(int number,
                                                                    const Polyhedron& solid) const;

  mutable std::mutex access_;
  mutable std::map<int, std::shared_ptr<const ClosestPointFinder>> finders_;  ///< of blocks requested so far
};

}  // namespace ashlar

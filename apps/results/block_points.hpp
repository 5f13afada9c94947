// Whether points are of a block, for callers who may ask for any: outside of it a polynomial goes on, but means nothing.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "geometry/any_solid/closest_point.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// What becomes of points that are not of the block.
enum class OutsidePoints { refused, extrapolated };

/// Of the blocks of a run, whose placed, undeformed solids stay the same. May be asked from many threads.
class BlockPoints {
 public:
  /// Points of a block are those inside, on its surface, or no farther from it than allowed_offset
  /// (mechanics/supports/face_selection.hpp), as the points of a scene: coordinates of a turned block are rounded.
  /// @param number of the block in the run. @param points m, of the placed, undeformed block
  /// @throws std::domain_error with the block, the first point that is not of it, and its distance
  void require(int number, const BlockModel& block, const std::vector<Vector3>& points) const;

 private:
  [[nodiscard]] std::shared_ptr<const ClosestPointFinder> finder_of(int number,
                                                                    const Polyhedron& solid) const;

  mutable std::mutex access_;
  mutable std::map<int, std::shared_ptr<const ClosestPointFinder>> finders_;  ///< of blocks asked for so far
};

}  // namespace ashlar

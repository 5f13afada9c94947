// Choice of the block with the reference face where edges and kinds do not decide
// (mechanics/contact/reference_face.hpp).
//
// The choice must not depend on the order of blocks in a scene or on left and right: equal blocks that slide on each
// other would change their motion by 1e-6 of the path. Heights against gravity and distances from the centroid of all
// blocks are the same for scenes listed in another order, rotated, translated or mirrored. They are those of the
// placed, undeformed blocks, so that the reference face of a pair is constant during motion.
#pragma once

#include <vector>

#include "mechanics/block/block_model.hpp"
#include "solver/contact/placed_volume.hpp"

namespace ashlar {

/// Places of blocks.
[[nodiscard]] std::vector<PlacedVolume> places_of(const std::vector<BlockModel>& blocks);

/// Constant after construction.
class ReferenceOrder {
 public:
  /// @param gravity m/s^2, of any length; zero: heights are not used
  ReferenceOrder(const std::vector<PlacedVolume>& blocks, const Vector3& gravity);

  /// True if a is before b: the higher block, or of blocks at the same height within rounding error the one farther
  /// from the centroid. If both are equal, the scene is symmetric with respect to the pair, and the later block is
  /// before the other.
  [[nodiscard]] bool is_before(int a, int b) const;

 private:
  std::vector<double> heights_;    ///< of centroids, m
  std::vector<double> distances_;  ///< of centroids from the mean of all centroids, by volume, m
  double rounding_ = 0.0;          ///< m, smaller differences are ignored
};

}  // namespace ashlar

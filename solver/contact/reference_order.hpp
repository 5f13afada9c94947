// Which of two blocks has the reference face where neither rims nor kinds tell (mechanics/contact/reference_face.hpp).
//
// The order of blocks in a scene must not tell, nor what is left and right: equal blocks that slide on each other
// would move otherwise by 1e-6 of their way. Heights against gravity and distances from the middle of all blocks are
// the same however a scene is listed, turned, moved or mirrored. They are those of the placed, undeformed blocks,
// so that the reference face of a pair stays the same on the way.
#pragma once

#include <vector>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Constant after construction.
class ReferenceOrder {
 public:
  /// @param gravity m/s^2, of any length; zero: heights do not tell
  ReferenceOrder(const std::vector<BlockModel>& blocks, const Vector3& gravity);

  /// The higher one of two blocks is before the other, of blocks that are as high but for rounding the one farther
  /// from the middle. Where both are the same a scene is alike to both sides of the pair, and the later one is.
  [[nodiscard]] bool is_before(int a, int b) const;

 private:
  std::vector<double> heights_;    ///< of centroids, m
  std::vector<double> distances_;  ///< of centroids from the mean of all centroids, by volume, m
  double rounding_ = 0.0;          ///< m, differences that do not count
};

}  // namespace ashlar

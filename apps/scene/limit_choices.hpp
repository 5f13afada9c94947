// Which joints and loads of a scene a search for a factor changes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "apps/scene/scene.hpp"

namespace ashlar {

/// The joints whose strength a search for a factor of safety divides (analysis.safety.joints).
class ReducedJoints {
 public:
  explicit ReducedJoints(const Scene& scene);

  /// @param a,b indices of blocks
  [[nodiscard]] bool contains(std::size_t a, std::size_t b) const;

 private:
  std::shared_ptr<const CutRock> rock_;
  std::vector<bool> block_, cut_;  ///< (#blocks), (#cuts) whether they are named
};

/// By block: whether a search for a capacity multiplies its loads (analysis.capacity.blocks).
[[nodiscard]] std::vector<bool> multiplied_blocks(const Scene& scene);

}  // namespace ashlar

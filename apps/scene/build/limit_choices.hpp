// Joints and loads of a scene that are changed by a search for a factor.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// The joints whose strength is divided by a search for a factor of safety (analysis.safety.joints).
class ReducedJoints {
 public:
  explicit ReducedJoints(const Scene& scene);

  /// @param a,b indices of blocks
  [[nodiscard]] bool contains(std::size_t a, std::size_t b) const;

 private:
  std::shared_ptr<const CutRock> rock_;
  std::vector<bool> block_, cut_;  ///< (#blocks), (#cuts) true if named
};

/// By block, true if its loads are multiplied by a search for a capacity (analysis.capacity.blocks).
[[nodiscard]] std::vector<bool> multiplied_blocks(const Scene& scene);

}  // namespace ashlar

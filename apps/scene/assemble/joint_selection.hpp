// Joints that a user names by cuts, or by blocks on either side: those of a search for a factor, those that hold water.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

class JointSelection {
 public:
  /// @param patterns names or globs of cuts and blocks
  JointSelection(const Scene& scene, const std::vector<std::string>& patterns);

  /// @param a,b indices of blocks
  [[nodiscard]] bool contains(std::size_t a, std::size_t b) const;

 private:
  std::shared_ptr<const CutRock> rock_;
  std::vector<bool> block_, cut_;  ///< (#blocks), (#cuts) true if named
};

}  // namespace ashlar

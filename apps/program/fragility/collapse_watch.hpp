// Collapse of blocks in a run: the first that has fallen or overturned.
//
// A block has fallen when its centroid is lower than it was placed by half its size, along gravity (motion_verdict.hpp). It
// has overturned when its direction that was vertical is more than overturned_tilt from the vertical: with the rotation
// by the angle t about the unit axis n since it was placed, and e against gravity,
//
//   cos(tilt) = e . R e = cos t + (1 - cos t) (n . e)^2
//
// so that a turn about the vertical is no tilt. Blocks that are fixed or moved by supports do neither, and blocks of the
// incremental formulation, whose rotation is not followed, are not judged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/results/folder/motion_verdict.hpp"
#include "apps/results/tables/measure.hpp"

namespace ashlar {

/// Degrees. A block that rests on an edge comes back from a smaller tilt only if it is less slender than a cube.
inline constexpr double overturned_tilt = 45.0;

struct Collapse {
  double time = 0.0;  ///< s
  std::string block;  ///< the first
  std::string how;    ///< "overturned" or "fallen"
};

class CollapseWatch {
 public:
  /// @param scene of the simulation
  CollapseWatch(const Scene& scene, const Simulation& simulation);

  /// The first block of the simulation that has collapsed in its present state; empty: none.
  [[nodiscard]] std::optional<Collapse> collapse_in(const Simulation& simulation) const;
  /// Number of blocks that are watched.
  [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
  /// s, in which a block that is not at rest moves perceptibly: 5 sqrt(L / g) with the largest size L of a block. Infinite
  /// without gravity.
  [[nodiscard]] double rest_duration() const { return rest_duration_; }

 private:
  std::vector<Measure> blocks_;  ///< each as a measured block
  double rest_duration_;
};

}  // namespace ashlar

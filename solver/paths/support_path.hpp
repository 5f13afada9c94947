// The path of a moving support in one direction, step by step (support_movement.hpp).
#pragma once

#include <optional>

#include "solver/block_pair.hpp"
#include "solver/paths/followed_blocks.hpp"
#include "solver/paths/support_movement.hpp"
#include "solver/paths/yielding_support.hpp"

namespace ashlar {

/// Characteristic lengths of a path (notes/limit_analysis.md).
struct PathLengths {
  /// @param smallest_block m, as smallest_size. @param contact_distance m
  PathLengths(double smallest_block, double contact_distance);

  /// Length of the next step in proportion to the displacement of blocks in the last one, m.
  /// @param step m, the last one. @param moved m, displacement of blocks in it. @param most factor
  [[nodiscard]] double next_step(double step, double moved, double most) const;

  double reach;                        ///< m, largest gap of detected points
  double farthest = 0.5 * reach;       ///< m, largest displacement of a block in a step: two blocks cannot
                                       ///< meet undetected
  double longest_step = 0.25 * reach;  ///< m, of the support
  double closed = 1e-4 * reach;        ///< m, motion below which closing of gaps ends
};

/// A support with the blocks that follow it, and its direction. The referenced objects must outlive the search.
struct SupportStart {
  const FollowedBlocks& blocks;
  const MovementLaw& movement_law;
  int support;  ///< block
  double sign;  ///< 1: along its coordinate, -1: against it
  PathLengths lengths;
  int threads = 1;
  /// A joint with half of its friction where the motion of a step is sought; equilibria have all friction. Empty: none
  std::optional<PairKey> slides_first;
};

/// Steps from equilibrium to equilibrium until the search ends.
[[nodiscard]] SupportPath path_of(const SupportStart& start, const MovementSearch& search);

}  // namespace ashlar

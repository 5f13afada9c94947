// Changing the order of a block: the basis is graded, so that its first functions span the lower orders
// (theory.md section 2). Raising adds zero coefficients and loses nothing; lowering drops trailing ones.
#pragma once

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// State of a block in another order, and the parts lost in the conversion.
struct OrderChange {
  BlockState state;
  double dropped_displacement;  ///< root of the mean square over the block, m; 0 for a higher order
  double dropped_velocity;      ///< likewise, m/s
};

/// @param state of `from`. @param to the same block (shape, supports) with another order
/// Supports are satisfied in the new order too: parts outside its clamped space count as dropped.
/// @throws std::invalid_argument if the two are not blocks of one solid or one of them is fixed
[[nodiscard]] OrderChange change_order(const BlockModel& from, const BlockState& state, const BlockModel& to);

}  // namespace ashlar

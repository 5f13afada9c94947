// Contacts of a divided block: the histories of its pairs go to the pairs of its parts, and the parts get a joint with the
// traction that was between them (notes/cracks.md).
#pragma once

#include <vector>

#include "solver/contact/pair_history.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// Parts of a block in the numbers of a run.
struct PartNumbers {
  int block = -1;            ///< the divided block, the number of the first part
  std::vector<int> numbers;  ///< of all parts, increasing
};

/// Moves the histories of a block to its parts: remembered points to the part at them, with the face of the part at them;
/// amounts of the whole pair in proportion to the areas of the points. Caches and clearances of these pairs end.
/// @param parts models in the order of their numbers. @param whole solid of the divided block
void divide_histories(const PartNumbers& divided, const Polyhedron& whole,
                      const std::vector<const BlockModel*>& parts, PairHistories& histories);

/// The memory with which a crack begins, by pair of parts: springs stretched and sheared so that every point has the
/// traction of the whole block's stress there, at most the strength of the joint.
/// @param system the parts alone, in the order of their numbers, with the law of the joint
/// @param states of the parts. @param whole,state the divided block
[[nodiscard]] std::map<PairKey, ContactMemory> crack_joints(const BlockSystem& system,
                                                            const std::vector<BlockState>& states,
                                                            const BlockModel& whole, const BlockState& state);

}  // namespace ashlar

// Quiet faces of blocks (quiet_faces.hpp) between rest and motion: held as by supports until the first step of a
// motion, released from then on, and held again by a static analysis.
//
// On release the reaction of the supports becomes a constant force. It balances the forces of elasticity, gravity,
// loads, contacts, ties and bolts of the present state on all motions of the block that its held faces excluded.
// From equilibrium nothing moves. Loads on a block that is placed without a static analysis and without initial stress
// act from the first instant on: the reaction has nothing of them. Waves and dashpots are no part of it: a state that moves is not slowed down.
#pragma once

#include <map>

#include "solver/step/step_caches.hpp"

namespace ashlar {

/// Releases quiet faces that are held. No effect without any. With several processes collective.
void release_quiet_faces(BlockSystem& system, RunState& state, StepCaches& caches);
/// Holds quiet faces that are released at their present places; their reactions are dropped.
void hold_quiet_faces(BlockSystem& system, RunState& state, StepCaches& caches);

/// Force behind the quiet faces of a block, (p, 3); empty: they are held, or there are none.
[[nodiscard]] Eigen::MatrixX3d released_reaction(const BlockModel& block);
/// Releases the quiet faces of a block with a reaction, or holds them. @param block with quiet faces
/// @param reaction as released_reaction(). @param library of the parts of released or held blocks
void set_reaction_of(BlockSystem& system, RunState& state, StepCaches& caches, int block,
                     const Eigen::MatrixX3d& reaction, BlockPartsLibrary& library);

/// Releases the quiet faces of these blocks, with these reactions, and holds those of all others.
/// @param reactions (p, 3) by block, of blocks with quiet faces
void set_reactions(BlockSystem& system, RunState& state, StepCaches& caches,
                   const std::map<int, Eigen::MatrixX3d>& reactions);

}  // namespace ashlar

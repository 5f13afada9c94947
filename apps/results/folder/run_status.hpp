// Status of a run as a word and as text: for the summary, for messages, and for callers that step it.
#pragma once

#include <string>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// How a run ended, as `status` in summary.json.
enum class RunStatus {
  completed,      ///< "completed": a dynamic run reached its end time
  failed,         ///< "failed": a step could not be taken
  interrupted,    ///< "interrupted"
  equilibrium,    ///< "equilibrium": a static analysis found it
  moving,         ///< "moving": a static analysis found none near: blocks move
  not_converged,  ///< "not converged": a static analysis was inconclusive
};
[[nodiscard]] std::string to_string(RunStatus status);

/// A block displaced by a static analysis.
struct DisplacedBlock {
  int block;
  double distance;  ///< root mean square over the block from its initial placement, m
};
/// Of a block's size: displacement from which on a block is no longer at its initial placement.
inline constexpr double displaced_share = 0.1;
/// Blocks displaced from their initial placement by more than that share of their size, except those on moving
/// supports: they are in equilibrium in another structure than the one built.
[[nodiscard]] std::vector<DisplacedBlock> displaced_blocks(const Simulation& simulation);

/// "block A moves, acceleration [0, 0, -9.81] m/s^2", or of several blocks their number, the first names, and the
/// acceleration of the fastest; those slower than a hundredth of it are counted apart. Empty if none moves. Components within rounding error are 0.
[[nodiscard]] std::string motion_in_words(const Simulation& simulation);
/// "no equilibrium: " and the same.
[[nodiscard]] std::string describe_motion(const Simulation& simulation);

/// "equilibrium, but far from where they were placed: block A by 1.2 m", or that only rigid blocks are known to be in
/// equilibrium; empty for an ordinary one.
[[nodiscard]] std::string describe_displaced(const Simulation& simulation);

/// "block A", for blocks that penetrate too deep with depth, place and allowed depth.
[[nodiscard]] std::string description_of(const StateFault& fault, const Simulation& simulation);

/// Reason for the rejection of a step, with the blocks and the place if known.
[[nodiscard]] std::string reason_of(const Rejection& rejection, const Simulation& simulation);

}  // namespace ashlar

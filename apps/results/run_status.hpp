// How a run has come out, in a word and in sentences: for the summary, for messages, for whoever steps it.
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
  moving,         ///< "moving": a static analysis found that there is none near: blocks move
  not_converged,  ///< "not converged": a static analysis found neither
};
[[nodiscard]] std::string to_string(RunStatus status);

/// A block that a static analysis has taken far.
struct DisplacedBlock {
  int block;
  double distance;  ///< root mean square over the block from where it was placed, m
};
/// Of a block's size: how far a block is from its place that is no more where it was built.
inline constexpr double displaced_share = 0.1;
/// Blocks farther than that share of their size from where they were placed, those on supports that move left
/// out: what they rest in is not what was built.
[[nodiscard]] std::vector<DisplacedBlock> displaced_blocks(const Simulation& simulation);

/// "no equilibrium: block A moves, acceleration [0, 0, -9.81] m/s^2", of the first five; "3 more blocks move"
[[nodiscard]] std::string describe_motion(const Simulation& simulation);

/// "equilibrium, but far from where they were placed: block A by 1.2 m"; empty if none is.
[[nodiscard]] std::string describe_displaced(const Simulation& simulation);

/// "block A", of blocks that are too deep in each other with depth, place and what is allowed.
[[nodiscard]] std::string description_of(const StateFault& fault, const Simulation& simulation);

/// Why a step was rejected, with the blocks and the place where that is known.
[[nodiscard]] std::string reason_of(const Rejection& rejection, const Simulation& simulation);

}  // namespace ashlar

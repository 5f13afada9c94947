// Motion that a static analysis need not follow: blocks that lack the same forces from one iteration to the next, and
// would meet nothing on the straight way on, move (notes/straight_way.md).
#pragma once

#include <vector>

#include "solver/contact/contact_finder.hpp"
#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// How far blocks are when the first one that nothing stops has gone far.
struct StraightWay {
  std::vector<double> travels;  ///< by block, in parts of its size; empty: no motion is sure yet
};

/// What an iteration of a static analysis says about the way on: of the blocks that lack the same as in the last one,
/// those that nothing stops before one of them has gone `far`. Before ContactFinder::check_motion of the iteration.
/// @param problem as solved, not accepted. @param far in block sizes, > 0
[[nodiscard]] StraightWay straight_way(const RunContext& run, const TimeScheme& scheme,
                                       const StepProblem& problem, const std::vector<FoundContacts>& found,
                                       double far);

/// Where motion is sure, takes blocks for moving, and for gone to the end of the way.
void note_way_on(const RunContext& run, const StraightWay& way);
/// Keeps what blocks lack for the next iteration. Before the problem is accepted.
void note_lacking(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem);

}  // namespace ashlar

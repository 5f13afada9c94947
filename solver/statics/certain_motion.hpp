// Early stop of certain motion in a static analysis: blocks whose residual is constant between iterations, and that
// would meet nothing on their straight path, are moving (notes/certain_motion.md).
#pragma once

#include <vector>

#include "solver/contact/contact_finder.hpp"
#include "solver/step/run_context.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Displacements of blocks when the first one without obstacle has gone far.
struct CertainMotion {
  std::vector<double> displacements;  ///< by block, in block sizes; empty: no motion is certain yet
};

/// Extrapolates an iteration: of the blocks with constant residual, those without obstacle until one of them has gone
/// `far`. To be called before ContactFinder::check_motion of the iteration.
/// @param problem as solved, not accepted. @param far in block sizes, > 0
[[nodiscard]] CertainMotion certain_motion(const RunContext& run, const TimeScheme& scheme,
                                           const StepProblem& problem,
                                           const std::vector<FoundContacts>& found, double far);

/// Marks the analysis as moving if motion is certain, with displacements at the end of the path.
void note_certain_motion(const RunContext& run, const CertainMotion& motion);
/// Stores the residuals of blocks for the next iteration. To be called before the problem is accepted.
void note_residuals(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem);

}  // namespace ashlar

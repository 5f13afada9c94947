// Early stop of certain motion in a static analysis: blocks whose residual is constant between iterations, and that
// would meet nothing on their straight path, are moving (notes/certain_motion.md).
#pragma once

#include <vector>

#include "solver/contact/contact_finder.hpp"
#include "solver/step/detect/step_contacts.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Displacements of blocks when the first one without obstacle has gone far.
struct CertainMotion {
  std::vector<double> displacements;  ///< by block, in block sizes; empty: no motion is certain yet
};

/// Motion of an iteration, followed to its end and beyond.
struct FollowedMotion {
  CertainMotion certain;
  std::vector<PassingBlocks>
      passing;  ///< StepContacts::check_motion of the iteration, of pairs of this process
  /// m, largest path of a block of any process on its way, if blocks that its process does not know may be there: nothing
  /// else is set then, neighbours have to be found. 0: all blocks on the way are known
  double beyond = 0.0;
};

/// Extrapolates an iteration: of the blocks with constant residual, those without obstacle until one of them has gone
/// `far` are certain to move. Checks the motion of the iteration itself, which is the last motion checked.
/// With other processes collective.
/// @param problem as solved, not accepted. @param far in block sizes, > 0.
[[nodiscard]] FollowedMotion follow_motion(const BlockSystem& system, RunState& state, StepContacts& contacts,
                                           const StepProblem& problem, double far);

/// Marks the analysis as moving if motion is certain, with displacements at the end of the path.
void note_certain_motion(StaticState& statics, const CertainMotion& motion);
/// Stores the residuals of blocks in a problem that is not accepted yet, for the next iteration.
void note_residuals(const BlockSystem& system, const StepProblem& problem, StaticState& statics);

}  // namespace ashlar

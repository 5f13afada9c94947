// Error of motion against run time, for the options of a user: order, integrator, step and formulation.
#pragma once

#include "apps/program/study/orders_study.hpp"
#include "apps/program/study/study.hpp"

namespace ashlar {

/// Extent of the study; the tests run less of it.
struct ErrorTimeStudySize {
  int steps = 6;       ///< lengths of a step for each curve, each half of the one before
  int repeats = 3;     ///< runs of each, of which the fastest counts
  int accuracies = 4;  ///< 0.1, 0.01, ... asked for
};

/// Ten problems, nine with known answers:
///   1 incline: a cube slides down 30 degrees under 20 degrees of friction for 0.4 s; the distance of a rigid cube is
///     (sin a - tan(phi) cos a) g t^2 / 2. A deformable cube oscillates after its release, and differs the more from a
///     rigid one the less a step damps this;
///   2 swelling: a free cube of order 1 swells and shrinks for five periods; it returns to its initial state;
///   3 tumbling: a free box of 1 x 2 x 3 m rotates for 5 s about its middle axis, which is unstable; Euler's equations,
///     integrated by the Runge-Kutta method with steps of 0.1 ms;
///   4 cantilever: statics of one block of orders 1 to 8 (orders_study.hpp);
///   5 to 8: plate and Hertz's sphere in statics, a block that rocks, two bars that meet (error_time_problems.hpp);
///   9 arch: statics of eight voussoirs with friction, without a closed form: the reference is a run of higher orders;
///   10 sliding: a rigid block that a pulse moves against friction (error_time_problems.hpp has 9 and 10).
/// Errors: distance, relative; strain and rate relative to their amplitudes; norm of the difference of the rotations;
/// tip deflection, relative. Contact is by multipliers, or by springs for some curves. The paper's scheme (dda,
/// incremental, point springs, flat sub-faces) is a curve of 1 to 3.
/// Columns: problem, curve (in the order of the picture), order, integrator (0 dda, 1 average-acceleration, 2
/// generalized-alpha), springs and incremental (0 or 1), time step (s; in problem 2 in periods, in 8 in durations of contact; 0: static), error,
/// seconds (of the processor, including the construction of the scene), front (1: no faster run has a smaller error),
/// accuracy (> 0: the step, or the order of the cantilever, is chosen for it as by analysis.accuracy), estimate (of the error,
/// by such a run).
/// An error that is not finite is a failed run.
[[nodiscard]] StudyResult study_error_time();

/// Runs of these problems whose step or order is chosen. @param accuracies number of them: 0.1, 0.01, ...
[[nodiscard]] std::vector<ChosenRun> chosen_runs(int accuracies);
[[nodiscard]] StudyResult study_error_time(const ErrorTimeStudySize& size);

}  // namespace ashlar

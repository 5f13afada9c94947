// Error of motion against run time, over what a user can choose: order, integrator, step and formulation.
#pragma once

#include "apps/study/study.hpp"

namespace ashlar {

/// How much of the study is run; the tests run less of it.
struct ErrorTimeStudySize {
  int steps = 6;    ///< lengths of a step for each curve, each half of the one before
  int repeats = 3;  ///< runs of each, of which the fastest counts
};

/// Four problems with answers that are known:
///   1 incline: a cube slides down 30 degrees under 20 degrees of friction for 0.4 s; the way is
///     (sin a - tan(phi) cos a) g t^2 / 2 of a rigid cube: one that deforms rings when it is let go, and the less a step
///     damps that, the farther it is from a rigid one;
///   2 swelling: a free cube of order 1 swells and shrinks for five periods; it is back, with the speed it had;
///   3 tumbling: a free box of 1 x 2 x 3 m turns for 5 s about its middle axis, where that is unstable; Euler's equations,
///     integrated by the method of Runge and Kutta with steps of 0.1 ms;
///   4 cantilever: statics of one block of orders 1 to 8 (orders_study.hpp).
/// Errors: of the way over the way; of strain and rate over their amplitudes; norm of the difference of the
/// rotations; of the tip. Multipliers hold contact, springs where a curve says so. The paper's scheme (dda,
/// incremental, point springs, flat sub-faces) is a curve of 1 to 3.
/// Columns: problem, curve (in the order of the picture), order, integrator (0 dda, 1 average-acceleration, 2
/// generalized-alpha), springs and incremental (0 or 1), time step (s; of problem 2 in periods; 0: static),
/// error, seconds (of the processor, with the building of the scene), front (1: nothing faster has less
/// error). An error that is not finite is a run that failed.
[[nodiscard]] StudyResult study_error_time();
[[nodiscard]] StudyResult study_error_time(const ErrorTimeStudySize& size);

}  // namespace ashlar

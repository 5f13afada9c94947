// Time steps and orders of blocks chosen for an accuracy, in a motion.
//
// Errors are relative to the largest values of the goals and of their rates, so that an error of velocity counts with the
// time in which it moves the goal; without goals to the largest energy and displacements of the motion. A pilot, a run of few steps whose state is
// taken back, measures them, and what the orders of blocks lack at any time: it is a round of static_accuracy.hpp, and
// repeated with higher orders until they suffice. Then, every few steps and after each change of contacts, one step is taken whole and in two
// halves. With an integrator of order p the local error of the whole step is their difference times 2^p / (2^p - 1)
// (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, II.4). The errors of the steps of an
// analysis of length T may add up to the accuracy, so that a step h may have the share h / T of it; steps are halved
// until they do, and doubled where twice the step would have less. The tests are taken back: a run with a chosen step is
// the same as one with the same steps given.
//
// An error that in four halvings falls no faster than the step is the tolerance of contact or rounding: the step stays.
// A step in which contacts change is of first order with any integrator and tells nothing about its neighbours: it is
// not used. Such steps are counted, and the largest distance v h that a block moved in one of them is the error of the
// place of an impact. If contacts change at speed in the pilot, a step is at most so long that this error is within the
// accuracy, h_i; after the first impact it is at least h_i / 8: shorter steps would resolve vibrations of a motion whose
// place is not known better. Orders are then chosen by the motion before the first impact, as each order changes what
// follows.
//
// The error of a step is that of all blocks. Each test also compares the two ends by islands, of blocks that touch or
// are joined (island_errors.hpp): the one with the largest error bounds the step.
//
// Notes: notes/accuracy.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "solver/accuracy/static_accuracy.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Largest values of a motion.
struct MotionScales {
  double energy = 0.0;        ///< J, kinetic and of strain, of all blocks
  double displacement = 0.0;  ///< m, root of the mean square over a block, of the block that moves most
  std::vector<double> goals;  ///< largest length of each goal's values
  std::vector<double> rates;  ///< largest length of each goal's rates
  /// m/s, largest of any block, root of the mean square, if contacts change at speed; 0: they do not
  double impact_speed = 0.0;
};

/// The island whose error bounds the step: the step is one for all blocks.
struct BoundingIsland {
  std::vector<int> blocks;  ///< in contact, tied or bolted; empty: unknown
  double gain =
      0.0;  ///< >= 1, times the step that all others would allow; 0: there are none, or they have no error
};

/// State of the choice, for checkpoints.
struct MotionAccuracyState {
  MotionScales scales;
  double time_step = 0.0;          ///< s, chosen; 0: that of the settings
  int since_test = 0;              ///< steps
  double local_error = 0.0;        ///< of a step of the present length, relative, from the last test
  double error = 0.0;              ///< sum of the local errors of all steps, relative
  double noise = 0.0;              ///< largest error that fell no faster than the step, relative
  double impact_error = 0.0;       ///< largest distance moved in a step in which contacts changed, relative
  std::int64_t impacts = 0;        ///< steps in which contacts changed
  std::int64_t tests = 0;          ///< steps tried whole and in halves
  std::vector<int> contact_marks;  ///< pairs in touch after the last step
  double shortest_step = 0.0;      ///< s, shortest that a test has chosen; 0: none yet
  BoundingIsland bounding;         ///< in that test
};

struct MotionRequest {
  double accuracy = 0.0;      ///< 0 to 1, relative
  double longest_step = 0.0;  ///< s, > 0
  double end_time = 0.0;      ///< s, of the analysis, which starts at 0
};

/// Largest values of a motion.
struct PilotRun {
  MotionScales scales;  ///< of all steps
  /// By component of a goal and by block, of the steps before contacts change at a tenth of the largest speed or more
  AccuracyRound round;
};

/// Runs to the end, in steps of the settings, and takes it back. A step that cannot be taken ends it. Rigid blocks under
/// constant loads have no vibrations: if 16 and 32 steps give the same scales within 20 % and no impacts, these are enough.
/// @param may_continue called before each step: false ends it. @return empty if it was ended
[[nodiscard]] std::optional<PilotRun> pilot_run(Simulation& simulation, double end_time,
                                                const GoalValues& goals,
                                                const std::function<bool()>& may_continue);

/// Before a step: chooses its length, if a test is due.
void choose_step(Simulation& simulation, const MotionRequest& request, const GoalValues& goals,
                 MotionAccuracyState& state);

/// After an accepted step: adds up its error.
void note_step(const Simulation& simulation, MotionAccuracyState& state);

}  // namespace ashlar

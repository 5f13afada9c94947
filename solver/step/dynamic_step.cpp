#include "solver/step/dynamic_step.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "solver/step/accepted_bolts.hpp"
#include "solver/step/accepted_step.hpp"
#include "solver/step/block_changes.hpp"
#include "solver/step/end_state.hpp"
#include "solver/step/position_projection.hpp"
#include "solver/step/quiet_release.hpp"
#include "solver/step/restitution.hpp"
#include "solver/step/sleeping_islands.hpp"
#include "solver/step/snapshot.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// One step: tried with smaller time steps, or with more contacts, until it can be accepted.
class DynamicStep {
 public:
  DynamicStep(const RunContext& run, double step)
      : run_(run), step_(step), found_(run.contacts.detect(run.system, run.state, step)) {}

  StepStatus run() {
    const SimulationSettings& settings = run_.settings();
    pair_up();
    rebound_from_touches();
    while (cuts_ <= settings.max_step_cuts && additions_ <= settings.max_step_cuts) {
      const TimeScheme scheme = time_scheme(settings, step_);
      const IslandStatus status = solve(run_.system, run_.state, scheme, run_.factors, problem_);
      if (status != IslandStatus::converged) {
        reject_unsettled(run_, step_, status, problem_);
        unconverged_ = true;
        cut(0.5);
      } else if (const auto share = share_until_impact(run_, step_, problem_);
                 share && cuts_ < settings.max_step_cuts) {
        cut(*share);
      } else if (const auto broken = broken_block(run_, problem_)) {
        reject(run_, step_, *broken);
        cut(0.5);
      } else if (const auto passing = blocks_that_pass(); !passing.empty()) {
        meet(passing);
      } else if (can_end()) {
        accept(run_, scheme, problem_);
        double& next = run_.state.next_step;
        next = std::min(settings.time_step, unconverged_ ? step_ : 2.0 * next);
        return StepStatus::accepted;
      }
    }
    take_back_moves();
    return StepStatus::too_many_cuts;
  }

 private:
  void cut(double share) {
    step_ *= share;
    ++cuts_;
  }

  /// Makes the contact pairs of the step. Separates blocks that are too deep beforehand.
  void pair_up() {
    const int most = run_.settings().multipliers.moves_apart;
    problem_.results.clear();
    problem_.pairs = run_.contacts.pairs(run_.system, run_.state, found_, PairUse::motion);
    while (wake_touched(run_, problem_.pairs)) detect();
    while (moves_ < most && too_deep(run_, problem_.pairs)) {
      if (!unmoved_) unmoved_ = snapshot_of(run_);
      if (!project_positions(run_, step_, problem_, found_, most)) break;
      ++moves_;
      do {
        detect();
      } while (wake_touched(run_, problem_.pairs));
    }
  }

  /// Impacts at the start of the step. Blocks that are struck may strike others at once: no more often than there are
  /// pairs.
  void rebound_from_touches() {
    for (std::size_t most = problem_.pairs.size(); most > 0 && rebound(run_, problem_.pairs); --most) {
      do {
        detect();
      } while (wake_touched(run_, problem_.pairs));
    }
  }

  void detect() {
    found_ = run_.contacts.detect(run_.system, run_.state, step_);
    problem_.pairs = run_.contacts.pairs(run_.system, run_.state, found_, PairUse::motion);
  }

  std::vector<PassingBlocks> blocks_that_pass() {
    const std::vector<BlockState> after = states_after(run_.system, run_.state, problem_);
    return run_.contacts.check_motion(run_.system, run_.state, after, found_);
  }

  /// Cuts the step to the first touch, or adds contacts where blocks resting on each other's edges would pass.
  void meet(const std::vector<PassingBlocks>& passing) {
    const double first = passing.front().touch.share;
    if (first > run_.settings().search.smallest_cut && cuts_ < run_.settings().max_step_cuts) {
      reject(run_, step_, RejectionReason::passing);
      cut(first);
      return;
    }
    ++additions_;
    found_ = with_passing(std::move(found_), passing);
    run_.state.log.counts.passing_contacts += passing.size();
    pair_up();
  }

  /// True if the step may end in its state; otherwise the step has been cut.
  bool can_end() {
    if (!carry_blocks(run_, problem_)) {
      reject(run_, step_, RejectionReason::no_shape);
      cut(0.5);
      return false;
    }
    const bool fine = (run_.state.steps + 1) % run_.settings().depth.fine_interval == 0;
    if (const auto deep = audit_depths(run_, problem_, fine)) {
      reject(run_, step_, *deep);
      cut(0.5);
      return false;
    }
    return true;
  }

  /// Undoes the separation of blocks; the log keeps its counts.
  void take_back_moves() {
    if (moves_ == 0) return;
    unmoved_->run.log = run_.state.log;
    unmoved_->run.log.counts = counts_of(run_.state, run_.contacts, run_.factors);
    restore(run_, *unmoved_);
  }

  const RunContext& run_;
  double step_;  ///< s
  std::vector<FoundContacts> found_;
  StepProblem problem_;
  std::optional<SimulationSnapshot> unmoved_;  ///< before blocks were separated
  int moves_ = 0;
  int cuts_ = 0;
  int additions_ = 0;
  bool unconverged_ = false;
};

}  // namespace

StepStatus take_step(const RunContext& run, double end_time) {
  release_quiet_faces(run);
  double step = run.state.next_step;
  const double left = end_time - run.state.time();
  if (left < step - time_rounding(run.settings().time_step, end_time)) step = left;
  if (run.settings().integrator == Integrator::generalized_alpha && run.state.accelerations.empty())
    run.state.accelerations = smooth_accelerations(run.system, run.state);
  wake_for_loads(run, step);
  commit_bolts(run.state);
  return DynamicStep(run, step).run();
}

}  // namespace ashlar

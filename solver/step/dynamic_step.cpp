#include "solver/step/dynamic_step.hpp"

#include <algorithm>
#include <any>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/accept/accepted_bolts.hpp"
#include "solver/step/accept/accepted_step.hpp"
#include "solver/step/accept/block_changes.hpp"
#include "solver/step/accept/position_projection.hpp"
#include "solver/step/accept/quiet_release.hpp"
#include "solver/step/accept/snapshot.hpp"
#include "solver/step/accept/turn_limit.hpp"
#include "solver/step/detect/end_state.hpp"
#include "solver/step/detect/sleeping_islands.hpp"
#include "solver/step/impact/restitution.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// One step: tried with smaller time steps, or with more contacts, until it can be accepted.
class DynamicStep {
 public:
  DynamicStep(const RunContext& run, double step)
      : run_(run),
        system_(run.system),
        state_(run.state),
        caches_(run.caches),
        fault_(run.fault),
        step_(step) {
    problem_.found = caches_.contacts.detect(system_, state_, step);
  }

  StepStatus run() {
    const SimulationSettings& settings = system_.settings();
    pair_up();
    rebound_from_touches();
    while (cuts_ <= settings.max_step_cuts && additions_ <= settings.max_step_cuts) {
      const TimeScheme scheme = time_scheme(settings, step_);
      const IslandStatus status = solve(system_, state_, scheme, caches_.factors, problem_);
      if (status != IslandStatus::converged) {
        const RejectionCause cause = cause_of_failure(system_, state_, problem_, status);
        fault_ = cause.fault;
        reject(state_, step_, cause.reason);
        unconverged_ = true;
        cut(0.5);
      } else if (const auto share = share_until_impact(system_, state_, step_, problem_);
                 share && cuts_ < settings.max_step_cuts) {
        cut(*share);
      } else if (const auto broken = first_of_run(system_, broken_block(system_, state_, problem_))) {
        reject_for(*broken);
      } else if (needs_other_neighbours()) {
        problem_.found = caches_.contacts.detect(system_, state_, step_);
        pair_up();
      } else if (const auto passing = blocks_that_pass(); any_of_run(system_, !passing.empty())) {
        meet(passing);
      } else if (can_end()) {
        accept(system_, state_, caches_, std::move(problem_));
        double& next = state_.next_step;
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
  void reject_for(const StateFault& fault) {
    fault_ = fault;
    reject(state_, step_, fault.reason);
    cut(0.5);
  }

  /// Makes the contact pairs of the step. Separates blocks that are too deep beforehand.
  void pair_up() {
    const int most = system_.settings().multipliers.moves_apart;
    problem_.results.clear();
    problem_.pairs = caches_.contacts.pairs(system_, state_, problem_.found, PairUse::motion);
    while (wake_touched(system_, state_, problem_.pairs)) detect();
    while (moves_ < most && too_deep(system_, state_, problem_.pairs)) {
      if (!unmoved_) {
        unmoved_ = snapshot_of(system_, state_, caches_);
        neighbours_of_unmoved_ = system_.exchange().neighbours();
      }
      if (!project_positions(system_, state_, caches_, step_, problem_)) break;
      ++moves_;
      (void)needs_other_neighbours({});
      do {
        detect();
      } while (wake_touched(system_, state_, problem_.pairs));
    }
  }

  /// Impacts at the start of the step. Blocks that are struck may strike others at once: no more often than there are
  /// pairs.
  void rebound_from_touches() {
    const auto pairs_here = static_cast<double>(problem_.pairs.size());
    if (!rebound(system_, state_, problem_.pairs)) return;
    double most = sum_of_run(system_, pairs_here);
    do {
      do {
        detect();
      } while (wake_touched(system_, state_, problem_.pairs));
      most -= 1.0;
    } while (most > 0.0 && rebound(system_, state_, problem_.pairs));
  }

  void detect() {
    problem_.found = caches_.contacts.detect(system_, state_, step_);
    problem_.pairs = caches_.contacts.pairs(system_, state_, problem_.found, PairUse::motion);
  }

  /// True if blocks have moved so far that neighbours have been found again.
  bool needs_other_neighbours(const std::function<Eigen::MatrixX3d(int block)>& motion) {
    const double travel = system_.exchange().travel_beyond(system_, caches_.contacts.finder(), motion);
    if (travel > 0.0) system_.exchange().find_neighbours(run_, travel);
    return travel > 0.0;
  }
  bool needs_other_neighbours() {
    return needs_other_neighbours([this](int block) { return problem_.bodies[at(block)].motion(); });
  }

  /// Of pairs of blocks that this process owns.
  std::vector<PassingBlocks> blocks_that_pass() {
    const std::vector<BlockState> after = states_after(system_, state_, problem_);
    std::vector<PassingBlocks> passing =
        caches_.contacts.check_motion(system_, state_, after, problem_.found);
    std::erase_if(passing, [this](const PassingBlocks& pair) {
      return !system_.owns_pair(pair.blocks[0], pair.blocks[1]);
    });
    return passing;
  }

  /// Cuts the step to the first touch, or adds contacts where blocks resting on each other's edges would pass.
  void meet(const std::vector<PassingBlocks>& passing) {
    const double first = least_of_run(
        system_, passing.empty() ? std::numeric_limits<double>::infinity() : passing.front().touch.share);
    if (first > system_.settings().search.smallest_cut && cuts_ < system_.settings().max_step_cuts) {
      reject(state_, step_, RejectionReason::passing);
      cut(first);
      return;
    }
    ++additions_;
    problem_.found = with_passing(std::move(problem_.found), passing);
    state_.log.counts.passing_contacts += passing.size();
    pair_up();
  }

  /// True if the step may end in its state; otherwise the step has been cut.
  bool can_end() {
    if (any_of_run(system_, !carry_blocks(system_, state_, problem_))) {
      reject(state_, step_, RejectionReason::no_shape);
      cut(0.5);
      return false;
    }
    const bool fine = (state_.steps + 1) % system_.settings().depth.fine_interval == 0;
    if (const auto deep = first_of_run(system_, audit_depths(system_, state_, caches_, problem_, fine))) {
      reject_for(*deep);
      return false;
    }
    return true;
  }

  /// Undoes the separation of blocks; the log keeps its counts.
  void take_back_moves() {
    if (moves_ == 0) return;
    unmoved_->run.log = state_.log;
    unmoved_->run.log.counts = counts_of(state_, caches_);
    system_.exchange().restore_neighbours(run_, neighbours_of_unmoved_);
    restore(system_, state_, caches_, *unmoved_);
  }

  const RunContext& run_;
  BlockSystem& system_;
  RunState& state_;
  StepCaches& caches_;
  std::optional<StateFault>& fault_;
  double step_;  ///< s
  StepProblem problem_;
  std::optional<SimulationSnapshot> unmoved_;  ///< before blocks were separated
  std::any neighbours_of_unmoved_;
  int moves_ = 0;
  int cuts_ = 0;
  int additions_ = 0;
  bool unconverged_ = false;
};

}  // namespace

StepStatus take_step(const RunContext& run, double end_time) {
  BlockSystem& system = run.system;
  RunState& state = run.state;
  const SimulationSettings& settings = system.settings();
  release_quiet_faces(system, state, run.caches);
  double step = state.next_step;
  const double left = end_time - state.time();
  if (left < step - time_rounding(settings.time_step, end_time)) step = left;
  step = limited_by_turns(system, state, step);
  if (settings.integrator == Integrator::generalized_alpha && state.accelerations.empty())
    state.accelerations = smooth_accelerations(system, state);
  system.exchange().before_step(run, step);
  wake_for_loads(system, state, step);
  commit_bolts(state);
  return DynamicStep(run, step).run();
}

}  // namespace ashlar

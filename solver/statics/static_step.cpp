#include "solver/statics/static_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/certain_motion.hpp"
#include "solver/statics/static_verdict.hpp"
#include "solver/step/accept/accepted_bolts.hpp"
#include "solver/step/accept/accepted_step.hpp"
#include "solver/step/accept/quiet_release.hpp"
#include "solver/step/detect/end_state.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// Inertia of iterations, as factors on the last one: of an attempt without a solution or with too large a motion (by its
/// ratio to the allowed one with a margin, within limits), and after an iteration that has converged. Faster growth and
/// slower decrease need more iterations, the reverse fails more often.
constexpr double inertia_growth = 10.0, inertia_decrease = 0.1;
constexpr double motion_margin = 1.1, least_raise = 2.0, most_raise = 1e4;

TimeScheme static_scheme(double inertia) {
  TimeScheme scheme;
  scheme.inertia = inertia;
  scheme.kind = StepKind::statics;
  return scheme;
}

/// Of all processes.
std::array<int, 3> contact_states(const BlockSystem& system, const StepReport& report) {
  std::array<int, 3> states{report.open, report.locked, report.sliding};
  const std::vector<double> sums = sum_of_run(system, std::vector<double>(states.begin(), states.end()));
  for (std::size_t k = 0; k < states.size(); ++k) states[k] = static_cast<int>(sums[k]);
  return states;
}

/// The smallest m of time_scheme.hpp used by iterations, 1/s^2: it restrains otherwise unrestrained blocks.
double least_inertia(const BlockSystem& system) {
  double most = 0.0;
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    const BlockModel& block = system.blocks()[k];
    if (!system.moving()[k] || block.unknowns() == 0) continue;
    // The contacts of a rigid block are as stiff as its material.
    const double stiffness =
        (block.rigid() ? block.parts()->stiffness : block.tangent(Eigen::Matrix3d::Identity()))
            .diagonal()
            .maxCoeff();
    most = std::max(most, stiffness / block.material().density);
  }
  most = most_of_run(system, most);
  const std::vector<bool> held = system.held_without_contacts();
  const bool all = all_of_run(system, std::find(held.begin(), held.end(), false) == held.end());
  return (all ? system.settings().statics.held_inertia_share : system.settings().statics.inertia_share) *
         most;
}

/// False before the first iteration at the present loads and orders.
bool has_level(const BlockSystem& system, const StaticState& statics) {
  return statics.level_start.size() == system.blocks().size();
}

void start_load_level(const BlockSystem& system, RunState& state, double end_time) {
  const double time_step = system.settings().time_step;
  StepClock& clock = state.clock;
  const bool changing = any_of_run(
      system, system.settings().gravity_history.changes_between(clock.time(), end_time) ||
                  std::any_of(system.blocks().begin(), system.blocks().end(), [&](const BlockModel& block) {
                    return block.loads_change_between(clock.time(), end_time);
                  }));
  if (changing && clock.time_after(time_step) < end_time - time_rounding(time_step, end_time)) {
    clock.advance(time_step);
  } else {
    clock = {.start = end_time};
  }
  // Between equilibria, inertia would make blocks slide that supports only carry along.
  StaticState& statics = state.statics;
  const bool from_equilibrium = statics.balanced || (statics.inertia > 0.0 && !has_level(system, statics));
  statics = StaticState{};
  if (from_equilibrium) statics.inertia = least_inertia(system);
  if (statics.inertia == 0.0) statics.inertia = 2.0 / (time_step * time_step);
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    BlockState& block = state.states[k];
    if (system.moving()[k] && system.owns(static_cast<int>(k)))
      state.ledger.integrator_took(system.blocks()[k].kinetic_energy(block));
    block.velocity.setZero();
    statics.progress.positions.push_back(block.position);
    statics.level_start.push_back(block.position);
  }
  statics.progress.forces.assign(system.blocks().size(), std::numeric_limits<double>::infinity());
  statics.progress.displacements.assign(system.blocks().size(), 0.0);
  for (auto& [blocks, pair] : state.pairs) pair.memory.start_level();
  commit_bolts(state);
  statics.freezes_failure = true;
  forget_accelerations(state);
}

/// From now on bonds fail if a balance exceeds their strength.
void let_bonds_go(RunState& state) {
  state.statics.freezes_failure = false;
  // Accelerations found with unbreakable bonds are not reported.
  forget_accelerations(state);
  // The distribution of a force over multipliers depends on the path; springs distribute it as stiff joints would.
  for (auto& [blocks, pair] : state.pairs) pair.memory.drop_multipliers();
}

/// Tells processes where their neighbours were at the start of the load level. Collective.
void tell_level_starts(const BlockSystem& system, RunState& state) {
  std::vector<Eigen::MatrixX3d>& starts = state.statics.level_start;
  system.exchange().tell_neighbours(
      [&starts](ByteWriter& writer, int block) { writer(starts[at(block)]); },
      [&starts](ByteReader& reader, int block) { reader(starts.at(at(block))); });
}

/// One iteration: repeated with larger inertia until it is accepted.
class StaticIteration {
 public:
  StaticIteration(const RunContext& run, double end_time, double far)
      : run_(run),
        system_(run.system),
        state_(run.state),
        caches_(run.caches),
        fault_(run.fault),
        end_time_(end_time),
        far_(far),
        least_(least_inertia(run.system)) {
    detect();
    StaticState& statics = state_.statics;
    statics.freezes_failure =
        statics.freezes_failure &&
        any_of_run(system_, std::any_of(problem_.pairs.begin(), problem_.pairs.end(),
                                        [](const ContactPair& p) { return p.bonded(); }));
  }

  StaticStatus run() {
    for (int cuts = 0; cuts <= system_.settings().statics.cuts;
         cuts += std::exchange(has_other_neighbours_, false) ? 0 : 1) {
      const TimeScheme scheme = static_scheme(std::max(state_.statics.inertia, least_));
      double raise = inertia_growth;
      if (const auto status = attempt(scheme, raise)) return *status;
      state_.statics.inertia = raise * scheme.inertia;
      cut_ = cut_ || raise > 1.0;
    }
    return give_up(system_, state_.statics);
  }

 private:
  void detect() {
    tell_level_starts(system_, state_);
    problem_.found = caches_.contacts.detect(system_, state_, 0.0);
    pair_up();
  }
  void pair_up() {
    problem_.pairs = caches_.contacts.pairs(system_, state_, problem_.found, PairUse::statics);
  }
  void reject_for(const StateFault& fault, double step) {
    fault_ = fault;
    reject(state_, step, fault.reason);
  }

  /// Length of the dda step equivalent to an iteration, s.
  static double step_of(const TimeScheme& scheme) { return std::sqrt(2.0 / scheme.inertia); }

  /// @param raise factor on inertia if the attempt fails
  std::optional<StaticStatus> attempt(const TimeScheme& scheme, double& raise) {
    const double step = step_of(scheme);
    const IslandStatus status = solve(system_, state_, scheme, caches_.factors, problem_);
    if (status != IslandStatus::converged) {
      const RejectionCause cause = cause_of_failure(system_, state_, problem_, status);
      fault_ = cause.fault;
      reject(state_, step, cause.reason);
      if (state_.statics.freezes_failure) {
        let_bonds_go(state_);
        pair_up();
      }
      return std::nullopt;
    }
    if (const auto broken = first_of_run(system_, broken_block(system_, state_, problem_))) {
      reject_for(*broken, step);
      return std::nullopt;
    }
    const double motion = most_of_run(system_, largest_motion(problem_));
    if (motion > system_.settings().statics.motion) {
      raise = std::clamp(motion_margin * motion / system_.settings().statics.motion, least_raise, most_raise);
      return std::nullopt;
    }
    if (needs_other_neighbours()) return again(raise);
    const FollowedMotion followed = follow_motion(system_, state_, caches_.contacts, problem_, far_);
    if (followed.beyond > 0.0) {
      system_.exchange().find_neighbours(run_, followed.beyond);
      return again(raise);
    }
    if (any_of_run(system_, !followed.passing.empty())) {
      raise = meet(step, followed.passing);
      return std::nullopt;
    }
    const auto deep = first_of_run(system_, audit_depths(system_, state_, caches_, problem_, false));
    if (deep && !has_gone_far()) {
      reject_for(*deep, step);
      return std::nullopt;
    }
    return take(followed.certain, motion);
  }

  /// True if blocks have moved so far that neighbours have been found again.
  bool needs_other_neighbours() {
    const double distance =
        system_.exchange().travel_beyond(system_, caches_.contacts.finder(),
                                         [this](int block) { return problem_.bodies[at(block)].motion(); });
    if (distance > 0.0) system_.exchange().find_neighbours(run_, distance);
    return distance > 0.0;
  }

  /// The same attempt with other neighbours, which is no cut.
  std::optional<StaticStatus> again(double& raise) {
    has_other_neighbours_ = true;
    raise = 1.0;
    problem_.results.clear();
    detect();
    return std::nullopt;
  }

  /// Treats blocks that would pass through each other. @return factor on inertia
  double meet(double step, const std::vector<PassingBlocks>& passing) {
    reject(state_, step, RejectionReason::passing);
    const double share = least_of_run(
        system_, passing.empty() ? std::numeric_limits<double>::infinity() : passing.front().touch.share);
    if (share <= system_.settings().search.smallest_cut) {
      problem_.found = with_passing(std::move(problem_.found), passing);
      state_.log.counts.passing_contacts += passing.size();
      pair_up();
      return 1.0;
    }
    // Rolling blocks touch again and again shortly before their last place of contact.
    const double raise = std::max(1.0 / share, cut_to_touch_ ? least_raise : 1.0);
    cut_to_touch_ = true;
    return raise;
  }

  /// Accepts the iteration, which is used up. @param motion in block sizes
  StaticStatus take(const CertainMotion& certain, double motion) {
    StaticState& statics = state_.statics;
    const TimeScheme scheme = problem_.scheme;
    const std::array<int, 3> before = contact_states(system_, state_.report);
    const bool balanced = note_balance(system_, state_, problem_);
    const bool converged = has_converged(system_, problem_);
    if (converged) note_certain_motion(statics, certain);
    if (balanced) {
      forget_accelerations(state_);
    } else {
      note_accelerations(system_, state_, caches_.factors.islands, problem_);
    }
    const bool repeat = multipliers_repeat(system_, problem_);
    const bool back = repeats_motion(system_, state_, problem_,
                                     converged && !statics.moving && !statics.freezes_failure && repeat &&
                                         (scheme.inertia <= least_ || least_ == 0.0));
    note_residuals(system_, problem_, statics);
    accept(system_, state_, caches_, std::move(problem_));
    state_.report.step = step_of(scheme);
    // Blocks that move although no bond can fail need no other iteration.
    if (statics.freezes_failure && !statics.moving && (balanced || has_gone_far())) let_bonds_go(state_);
    if (!converged) {
      statics.inertia = inertia_growth * scheme.inertia;
    } else if (!cut_) {
      statics.inertia = std::max(inertia_decrease * scheme.inertia, least_);
    }
    const bool ruptured = (balanced || has_gone_far()) && rupture_bolts(system_, state_);
    const bool still =
        balanced && !ruptured && (scheme.inertia <= least_ || least_ == 0.0) &&
        (before == contact_states(system_, state_.report) || motion <= system_.settings().statics.stillness);
    if (still && !repeat) ++statics.multiplier_iterations;
    const bool at_rest =
        still && (repeat || statics.multiplier_iterations > system_.settings().statics.multiplier_iterations);
    statics.still_iterations = at_rest ? statics.still_iterations + 1 : 0;
    statics.balanced = statics.still_iterations >= 2 || (back && !ruptured);
    // Iterations are audited after large motion, and roughly after the onset of motion; an equilibrium is audited
    // completely.
    if (statics.balanced) {
      const PresentDepths present = audit_present(system_, state_, caches_);
      if (const auto fault = first_of_run(system_, present.fault)) {
        reject_for(*fault, step_of(scheme));
        return give_up(system_, statics);
      }
      if (any_of_run(system_, present.unexpected)) {
        statics.balanced = false;
        statics.still_iterations = 0;
      }
    }
    if (statics.balanced)
      return state_.reached(system_.settings().time_step, end_time_) ? StaticStatus::equilibrium
                                                                     : StaticStatus::balancing;
    return statics.moving ? StaticStatus::moving : StaticStatus::balancing;
  }

  [[nodiscard]] bool has_gone_far() const { return has_set_off(system_, state_.statics); }

  const RunContext& run_;
  BlockSystem& system_;
  RunState& state_;
  StepCaches& caches_;
  std::optional<StateFault>& fault_;
  double end_time_;
  double far_;    ///< in block sizes
  double least_;  ///< inertia, 1/s^2
  StepProblem problem_;
  bool cut_ = false;
  bool cut_to_touch_ = false;
  bool has_other_neighbours_ = false;  ///< found in the last attempt
};

}  // namespace

StaticStatus static_step(const RunContext& run, double end_time, double far) {
  BlockSystem& system = run.system;
  RunState& state = run.state;
  if (system.any_incremental()) throw std::logic_error("incremental blocks have no static analysis");
  hold_quiet_faces(system, state, run.caches);
  StaticState& statics = state.statics;
  if (statics.moving) return StaticStatus::moving;
  if (statics.balanced && state.reached(system.settings().time_step, end_time))
    return StaticStatus::equilibrium;
  if (statics.inertia == 0.0 || statics.balanced || !has_level(system, statics))
    start_load_level(system, state, end_time);
  if (statics.iterations >= system.settings().statics.iterations) return give_up(system, statics);
  ++statics.iterations;
  system.exchange().before_step(run, 0.0);
  return StaticIteration(run, end_time, far).run();
}

}  // namespace ashlar

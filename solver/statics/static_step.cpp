#include "solver/statics/static_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/statics/certain_motion.hpp"
#include "solver/statics/static_verdict.hpp"
#include "solver/step/accepted_bolts.hpp"
#include "solver/step/accepted_step.hpp"
#include "solver/step/end_state.hpp"
#include "solver/step/quiet_release.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

TimeScheme static_scheme(double inertia) {
  TimeScheme scheme;
  scheme.inertia = inertia;
  scheme.kind = StepKind::statics;
  return scheme;
}

std::array<int, 3> contact_states(const StepReport& report) {
  return {report.open, report.locked, report.sliding};
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
  const std::vector<bool> held = system.held_without_contacts();
  const bool all = std::find(held.begin(), held.end(), false) == held.end();
  return (all ? system.settings().statics.held_inertia_share : system.settings().statics.inertia_share) *
         most;
}

void start_load_level(const RunContext& run, double end_time) {
  const double time_step = run.settings().time_step;
  StepClock& clock = run.state.clock;
  const bool changing = run.settings().gravity_history.changes_between(clock.time(), end_time) ||
                        std::any_of(run.blocks().begin(), run.blocks().end(), [&](const BlockModel& block) {
                          return block.loads_change_between(clock.time(), end_time);
                        });
  if (changing && clock.time_after(time_step) < end_time - time_rounding(time_step, end_time)) {
    clock.advance(time_step);
  } else {
    clock = {.start = end_time};
  }
  // Between equilibria, inertia would make blocks slide that supports only carry along.
  StaticState& statics = run.state.statics;
  const bool from_equilibrium = statics.balanced;
  statics = StaticState{};
  if (from_equilibrium) statics.inertia = least_inertia(run.system);
  if (statics.inertia == 0.0) statics.inertia = 2.0 / (time_step * time_step);
  for (std::size_t k = 0; k < run.blocks().size(); ++k) {
    BlockState& state = run.state.states[k];
    if (run.system.moving()[k]) run.state.ledger.integrator_took(run.blocks()[k].kinetic_energy(state));
    state.velocity.setZero();
    statics.progress.positions.push_back(state.position);
    statics.level_start.push_back(state.position);
  }
  statics.progress.forces.assign(run.blocks().size(), std::numeric_limits<double>::infinity());
  statics.progress.displacements.assign(run.blocks().size(), 0.0);
  for (auto& [blocks, pair] : run.state.pairs) pair.memory.start_level();
  commit_bolts(run.state);
  statics.freezes_failure = true;
  forget_accelerations(run);
}

/// From now on bonds fail if a balance exceeds their strength.
void let_bonds_go(const RunContext& run) {
  run.state.statics.freezes_failure = false;
  // Accelerations found with unbreakable bonds are not reported.
  forget_accelerations(run);
  // The distribution of a force over multipliers depends on the path; springs distribute it as stiff joints would.
  for (auto& [blocks, pair] : run.state.pairs) pair.memory.drop_multipliers();
}

/// One iteration: repeated with larger inertia until it is accepted.
class StaticIteration {
 public:
  StaticIteration(const RunContext& run, double end_time, double far)
      : run_(run),
        end_time_(end_time),
        far_(far),
        least_(least_inertia(run.system)),
        found_(run.contacts.detect(run.system, run.state, 0.0)) {
    pair_up();
    StaticState& statics = run.state.statics;
    statics.freezes_failure =
        statics.freezes_failure && std::any_of(problem_.pairs.begin(), problem_.pairs.end(),
                                               [](const ContactPair& p) { return p.bonded(); });
  }

  StaticStatus run() {
    for (int cuts = 0; cuts <= run_.settings().statics.cuts; ++cuts) {
      const TimeScheme scheme = static_scheme(std::max(run_.state.statics.inertia, least_));
      double raise = 10.0;
      if (const auto status = attempt(scheme, raise)) return *status;
      run_.state.statics.inertia = raise * scheme.inertia;
      cut_ = cut_ || raise > 1.0;
    }
    return give_up(run_);
  }

 private:
  void pair_up() { problem_.pairs = run_.contacts.pairs(run_.system, run_.state, found_, PairUse::statics); }

  /// Length of the dda step equivalent to an iteration, s.
  static double step_of(const TimeScheme& scheme) { return std::sqrt(2.0 / scheme.inertia); }

  /// @param raise factor on inertia if the attempt fails
  std::optional<StaticStatus> attempt(const TimeScheme& scheme, double& raise) {
    const double step = step_of(scheme);
    const IslandStatus status = solve(run_.system, run_.state, scheme, run_.factors, problem_);
    if (status != IslandStatus::converged) {
      reject_unsettled(run_, step, status, problem_);
      if (run_.state.statics.freezes_failure) {
        let_bonds_go(run_);
        pair_up();
      }
      return std::nullopt;
    }
    if (const auto broken = broken_block(run_, problem_)) {
      reject(run_, step, *broken);
      return std::nullopt;
    }
    const double motion = largest_motion(problem_);
    if (motion > run_.settings().statics.motion) {
      raise = std::clamp(1.1 * motion / run_.settings().statics.motion, 2.0, 1e4);
      return std::nullopt;
    }
    certain_motion_ = certain_motion(run_, scheme, problem_, found_, far_);
    const std::vector<BlockState> after = states_after(run_.system, run_.state, problem_);
    if (const auto passing = run_.contacts.check_motion(run_.system, run_.state, after, found_);
        !passing.empty()) {
      raise = meet(step, passing);
      return std::nullopt;
    }
    const auto deep = audit_depths(run_, problem_, false);
    if (deep && !has_set_off(run_)) {
      reject(run_, step, *deep);
      return std::nullopt;
    }
    return take(scheme, motion);
  }

  /// Treats blocks that would pass through each other. @return factor on inertia
  double meet(double step, const std::vector<PassingBlocks>& passing) {
    reject(run_, step, RejectionReason::passing);
    const double share = passing.front().touch.share;
    if (share <= run_.settings().search.smallest_cut) {
      found_ = with_passing(std::move(found_), passing);
      run_.state.log.counts.passing_contacts += passing.size();
      pair_up();
      return 1.0;
    }
    // Rolling blocks touch again and again shortly before their last place of contact.
    const double raise = std::max(1.0 / share, cut_to_touch_ ? 2.0 : 1.0);
    cut_to_touch_ = true;
    return raise;
  }

  /// Accepts the iteration. @param motion in block sizes
  StaticStatus take(const TimeScheme& scheme, double motion) {
    StaticState& statics = run_.state.statics;
    const std::array<int, 3> before = contact_states(run_.state.report);
    const bool balanced = note_balance(run_, scheme, problem_);
    if (has_converged(problem_)) note_certain_motion(run_, certain_motion_);
    if (balanced) {
      forget_accelerations(run_);
    } else {
      note_accelerations(run_, scheme, problem_);
    }
    const bool repeat = multipliers_repeat(run_, problem_);
    note_residuals(run_, scheme, problem_);
    accept(run_, scheme, problem_);
    run_.state.report.step = step_of(scheme);
    if (statics.freezes_failure && (balanced || has_set_off(run_))) let_bonds_go(run_);
    if (!has_converged(problem_)) {
      statics.inertia = 10.0 * scheme.inertia;
    } else if (!cut_) {
      statics.inertia = std::max(0.1 * scheme.inertia, least_);
    }
    const bool ruptured = (balanced || has_set_off(run_)) && rupture_bolts(run_);
    const bool still =
        balanced && !ruptured && (scheme.inertia <= least_ || least_ == 0.0) &&
        (before == contact_states(run_.state.report) || motion <= run_.settings().statics.stillness);
    if (still && !repeat) ++statics.multiplier_iterations;
    const bool settled =
        still && (repeat || statics.multiplier_iterations > run_.settings().statics.multiplier_iterations);
    statics.still_iterations = settled ? statics.still_iterations + 1 : 0;
    statics.balanced = statics.still_iterations >= 2;
    // Iterations are audited after large motion, and roughly after the onset of motion; an equilibrium is audited
    // completely.
    if (statics.balanced) {
      const PresentDepths present = audit_present(run_);
      if (present.fault) {
        reject(run_, step_of(scheme), *present.fault);
        return give_up(run_);
      }
      if (present.unexpected) {
        statics.balanced = false;
        statics.still_iterations = 0;
      }
    }
    if (statics.balanced)
      return run_.state.reached(run_.settings().time_step, end_time_) ? StaticStatus::equilibrium
                                                                      : StaticStatus::balancing;
    return statics.moving ? StaticStatus::moving : StaticStatus::balancing;
  }

  const RunContext& run_;
  double end_time_;
  double far_;    ///< in block sizes
  double least_;  ///< inertia, 1/s^2
  std::vector<FoundContacts> found_;
  StepProblem problem_;
  CertainMotion certain_motion_;
  bool cut_ = false;
  bool cut_to_touch_ = false;
};

}  // namespace

StaticStatus static_step(const RunContext& run, double end_time, double far) {
  if (run.system.any_incremental()) throw std::logic_error("incremental blocks have no static analysis");
  hold_quiet_faces(run);
  StaticState& statics = run.state.statics;
  if (statics.moving) return StaticStatus::moving;
  if (statics.balanced && run.state.reached(run.settings().time_step, end_time))
    return StaticStatus::equilibrium;
  if (statics.inertia == 0.0 || statics.balanced) start_load_level(run, end_time);
  if (statics.iterations >= run.settings().statics.iterations) return give_up(run);
  ++statics.iterations;
  return StaticIteration(run, end_time, far).run();
}

std::vector<std::vector<int>> loose_blocks(const RunContext& run) {
  const std::vector<ContactPair> pairs = run.contacts.pairs(
      run.system, run.state, run.contacts.detect(run.system, run.state, 0.0), PairUse::statics);
  std::vector<std::vector<int>> loose;
  const std::vector<StepBolt> bolts =
      step_bolts(run.system.bolts(), run.state.bolts, run.blocks(), run.state.states, run.system.moving());
  for (const Island& island : find_islands(run.system.moving(), pairs, bolts)) {
    bool held = island.pairs.empty() && island.bodies.size() == 1 &&
                run.blocks()[at(island.bodies.front())].space().held();
    for (const int index : island.pairs) {
      const ContactPair& pair = pairs[at(index)];
      for (const int block : {pair.a(), pair.b()}) {
        const BlockModel& model = run.blocks()[at(block)];
        held = held || model.fixed() || model.supported();
      }
    }
    for (const StepBolt* bolt : island.bolts)
      for (const int block : bolt->blocks())
        held = held || run.blocks()[at(block)].fixed() || run.blocks()[at(block)].supported();
    if (!held) loose.push_back(island.bodies);
  }
  return loose;
}

}  // namespace ashlar

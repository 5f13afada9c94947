#include "solver/statics/rigid_verdict.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "solver/limit/crushing_joints.hpp"
#include "solver/limit/limit_analysis.hpp"
#include "solver/paths/followed_collapse.hpp"
#include "solver/paths/load_path.hpp"

namespace ashlar {
namespace {

/// True if blocks are at their initial placement; others have reached their place by motion.
bool is_where_placed(const BlockSystem& system, const RunState& state) {
  const double share = system.settings().statics.motion;
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    const BlockModel& block = system.blocks()[k];
    if (!system.moving()[k]) continue;
    if (mean_motion(block, state.states[k].position - block.initial_state().position) > share * block.size())
      return false;
  }
  return true;
}

bool can_tell(const BlockSystem& system, const RunState& state, double end_time) {
  if (system.any_incremental() || state.remembers_statics) return false;
  if (system.settings().gravity_history.changes_between(0.0, end_time)) return false;
  return std::none_of(system.blocks().begin(), system.blocks().end(), [&](const BlockModel& block) {
    return block.driven() || block.initial_stress() || block.loads_change_between(0.0, end_time);
  });
}

/// True if neither blocks nor joints have compliance.
bool is_rigid(const BlockSystem& system, const RigidModel& model) {
  for (std::size_t k = 0; k < system.blocks().size(); ++k)
    if (system.moving()[k] && !system.blocks()[k].rigid()) return false;
  return std::all_of(model.points.begin(), model.points.end(),
                     [](const RigidPoint& point) { return point.law.rigid; });
}

void note_motion(const BlockSystem& system, RunState& state, const LimitMotion& motion) {
  StaticState& statics = state.statics;
  const std::size_t count = system.blocks().size();
  statics.moving = true;
  statics.balanced = false;
  statics.progress.displacements.assign(count, 0.0);
  statics.onset.unbalanced.assign(count, Eigen::MatrixX3d());
  for (std::size_t k = 0; k < count; ++k)
    statics.onset.unbalanced[k].setZero(state.states[k].position.rows(), 3);
  statics.onset.rigid = true;
  for (const LimitMotion::Block& block : motion.blocks) {
    const std::size_t k = at(block.block);
    statics.progress.displacements[k] = system.settings().statics.displacement_limit;
    statics.onset.unbalanced[k] =
        rigid_velocity(state.states[k].position, system.blocks()[k].basis().volume(), block.about,
                       block.acceleration, block.angular_acceleration);
  }
}

/// Blocks at their initial placement with their initial overlaps.
RunState as_placed(const BlockSystem& system, const PairHistories& pairs) {
  RunState placed;
  for (const BlockModel& block : system.blocks()) placed.states.push_back(block.initial_state());
  for (const auto& [blocks, history] : pairs) placed.pairs[blocks].overlap = history.overlap;
  return placed;
}

/// Blocks at their positions at the start of the present load level.
RunState at_level_start(const BlockSystem& system, const RunState& state) {
  RunState start = as_placed(system, state.pairs);
  for (std::size_t k = 0; k < start.states.size(); ++k)
    start.states[k].position = state.statics.level_start[k];
  return start;
}

/// True if blocks neither change by themselves nor are driven.
bool has_fixed_supports(const BlockSystem& system) {
  return !system.any_incremental() && std::none_of(system.blocks().begin(), system.blocks().end(),
                                                   [](const BlockModel& block) { return block.driven(); });
}

/// Verdict on an analysis without a result at a level of changed loads: nothing stands beyond the associated limit,
/// whatever forces remain from earlier levels. Blocks are at their positions at the start of the level. A table
/// tilted to its friction angle is at the limit, which is known to a part in a thousand (notes/limit_analysis.md).
StaticStatus verdict_on_level(const BlockSystem& system, RunState& state, StaticStatus status) {
  constexpr double at_the_limit = 1.001;
  if (status != StaticStatus::not_converged || !has_fixed_supports(system)) return status;
  if (state.statics.level_start.empty()) return status;
  RigidModel model = rigid_model(system, at_level_start(system, state), state.time(), {});
  if (loses_strength(model) || model.bodies.empty()) return status;
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return true; }, system.settings().threads);
  const LimitTrial trial = analysis.associated({at_the_limit, 1.0});
  if (trial.outcome != LimitOutcome::moves) return status;
  note_motion(system, state, analysis.motion_of(trial));
  return StaticStatus::moving;
}

/// True if all joints have friction only.
bool is_dry(const RigidModel& model) {
  return std::all_of(model.points.begin(), model.points.end(), [](const RigidPoint& point) {
    return !point.bar && !(point.law.cohesion > 0.0) && !(point.law.tensile_strength > 0.0);
  });
}

/// True if joints have a compressive strength, which the load path does not have.
bool any_crush(const RigidModel& model) {
  return std::any_of(model.points.begin(), model.points.end(), crushes);
}

/// Verdict on an analysis without a result. @param placed blocks at their initial placement
StaticStatus verdict_of_path(const BlockSystem& system, const RunState& placed, double end_time,
                             RunState& state) {
  RigidModel model = rigid_model(system, placed, end_time, {}, RigidPointKind::springs);
  std::vector<double> allowed = displacements_of_rest(system, model);
  LoadPath path(
      std::move(model), [](int, int) { return false; }, std::move(allowed));
  const PathTrial trial = path.to(path.unloaded(), {});
  if (trial.outcome == LimitOutcome::moves) {
    note_motion(system, state, limit_motion(path.model(), path.program(), path.motion_of(trial, {})));
    return StaticStatus::moving;
  }
  if (trial.outcome != LimitOutcome::stands) return StaticStatus::not_converged;
  for (std::size_t k = 0; k < placed.states.size(); ++k)
    state.states[k].position = system.blocks()[k].initial_state().position;
  state.records = contact_records(path.model(), in_newtons(path.model(), trial.end.force));
  state.statics.balanced = true;
  state.statics.moving = false;
  state.statics.rests_rigidly = true;
  state.clock = {.start = end_time};
  return StaticStatus::equilibrium;
}

}  // namespace

StaticStatus rigid_verdict(const BlockSystem& system, RunState& state, double end_time, StaticStatus status) {
  if (!can_tell(system, state, end_time)) return verdict_on_level(system, state, status);
  if (status == StaticStatus::equilibrium && !is_where_placed(system, state)) return status;
  const RunState placed = as_placed(system, state.pairs);
  RigidModel model = rigid_model(system, placed, end_time, {});
  if (loses_strength(model) || model.bodies.empty()) return status;
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return false; }, system.settings().threads);
  const LimitTrial trial = analysis.released({});
  // Blocks are in balance on contacts where rigid blocks have no forces: the rigid model is inconclusive.
  if (status == StaticStatus::equilibrium && !trial.balanced) return status;
  if (trial.outcome == LimitOutcome::moves) {
    note_motion(system, state, analysis.motion_of(trial));
    return StaticStatus::moving;
  }
  if (status == StaticStatus::moving) {
    state.statics.moving = false;
    return StaticStatus::not_converged;
  }
  // Iterations that fail from the start are those of numbers out of range.
  const bool tried = state.statics.iterations >= system.settings().statics.iterations;
  if (status == StaticStatus::equilibrium || !(tried || is_rigid(system, analysis.model()))) return status;
  if (any_crush(analysis.model())) return status;
  return verdict_of_path(system, placed, end_time, state);
}

bool has_accelerations(const StaticState& statics) {
  return std::any_of(statics.onset.unbalanced.begin(), statics.onset.unbalanced.end(),
                     [](const Eigen::MatrixX3d& acceleration) { return !acceleration.isZero(0.0); });
}

StaticStatus rigid_collapse(const BlockSystem& system, RunState& state, double end_time) {
  constexpr double stronger = 1.0 / 1.001;
  if (!has_fixed_supports(system) || state.statics.level_start.empty() ||
      !state.reached(system.settings().time_step, end_time))
    return StaticStatus::balancing;
  const RunState start = at_level_start(system, state);
  RigidModel model = rigid_model(system, start, end_time, {});
  if (model.bodies.empty() || !is_dry(model) || loses_strength(model)) return StaticStatus::balancing;
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return true; }, system.settings().threads);
  const LimitTrial trial = analysis.associated({stronger, 1.0});
  if (trial.outcome != LimitOutcome::moves) return StaticStatus::balancing;
  const Collapse collapse =
      follow_collapse({system, start.states, start.pairs, end_time, system.settings().threads},
                      system.settings().statics.displacement_limit);
  if (collapse.end != CollapseEnd::goes_far) return StaticStatus::balancing;
  // Accelerations at the onset are those of the iterations, with the compliance that they have, if blocks moved there.
  StaticState& statics = state.statics;
  if (!has_accelerations(statics)) note_motion(system, state, analysis.motion_of(trial));
  statics.moving = true;
  statics.progress.displacements = collapse.displacements;
  return StaticStatus::moving;
}

}  // namespace ashlar

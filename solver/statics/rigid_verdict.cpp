#include "solver/statics/rigid_verdict.hpp"

#include <algorithm>

#include "geometry/index.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "solver/state/automatic.hpp"
#include "solver/statics/limit_analysis.hpp"

namespace ashlar {
namespace {

/// True if blocks are at their initial placement; others have reached their place by motion.
bool is_where_placed(const RunContext& run) {
  const double share = run.settings().statics.motion;
  for (std::size_t k = 0; k < run.blocks().size(); ++k) {
    const BlockModel& block = run.blocks()[k];
    if (!run.system.moving()[k]) continue;
    if (mean_motion(block, run.state.states[k].position - block.initial_state().position) >
        share * block_size(block))
      return false;
  }
  return true;
}

bool can_tell(const RunContext& run, double end_time) {
  if (run.system.any_incremental() || run.state.remembers_statics) return false;
  if (run.settings().gravity_history.changes_between(0.0, end_time)) return false;
  return std::none_of(run.blocks().begin(), run.blocks().end(), [&](const BlockModel& block) {
    return block.driven() || block.initial_stress() || block.loads_change_between(0.0, end_time);
  });
}

/// True if neither blocks nor joints have compliance.
bool is_rigid(const RunContext& run, const RigidModel& model) {
  for (std::size_t k = 0; k < run.blocks().size(); ++k)
    if (run.system.moving()[k] && !run.blocks()[k].rigid()) return false;
  return std::all_of(model.points.begin(), model.points.end(),
                     [](const RigidPoint& point) { return point.law.rigid; });
}

void note_motion(const RunContext& run, const LimitMotion& motion) {
  StaticState& statics = run.state.statics;
  const std::size_t count = run.blocks().size();
  statics.moving = true;
  statics.balanced = false;
  statics.progress.displacements.assign(count, 0.0);
  statics.onset.unbalanced.assign(count, Eigen::MatrixX3d());
  for (std::size_t k = 0; k < count; ++k)
    statics.onset.unbalanced[k].setZero(run.state.states[k].position.rows(), 3);
  statics.onset.rigid = true;
  for (const LimitMotion::Block& block : motion.blocks) {
    const std::size_t k = at(block.block);
    statics.progress.displacements[k] = run.settings().statics.displacement_limit;
    statics.onset.unbalanced[k] =
        rigid_velocity(run.state.states[k].position, run.blocks()[k].basis().volume(), block.about,
                       block.acceleration, block.angular_acceleration);
  }
}

/// Blocks at their initial placement with their initial overlaps.
RunState as_placed(const RunContext& run) {
  RunState placed;
  for (const BlockModel& block : run.blocks()) placed.states.push_back(block.initial_state());
  for (const auto& [blocks, history] : run.state.pairs) placed.pairs[blocks].overlap = history.overlap;
  return placed;
}

/// Verdict on an analysis without a result at a level of changed loads: nothing stands beyond the associated limit,
/// whatever forces remain from earlier levels. Blocks are at their positions at the start of the level. A table
/// tilted to its friction angle is at the limit, which is known to a part in a thousand (notes/limit_analysis.md).
StaticStatus verdict_on_level(const RunContext& run, StaticStatus status) {
  constexpr double at_the_limit = 1.001;
  const bool driven = std::any_of(run.blocks().begin(), run.blocks().end(),
                                  [](const BlockModel& block) { return block.driven(); });
  if (status != StaticStatus::not_converged || run.system.any_incremental() || driven) return status;
  if (run.state.statics.level_start.empty()) return status;
  RunState start = as_placed(run);
  for (std::size_t k = 0; k < start.states.size(); ++k)
    start.states[k].position = run.state.statics.level_start[k];
  RigidModel model = rigid_model(run.system, start, run.state.time(), {});
  if (loses_strength(model) || model.bodies.empty()) return status;
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return true; }, run.settings().threads);
  const LimitTrial trial = analysis.associated({at_the_limit, 1.0});
  if (trial.outcome != LimitOutcome::moves) return status;
  note_motion(run, analysis.motion_of(trial));
  return StaticStatus::moving;
}

}  // namespace

StaticStatus rigid_verdict(const RunContext& run, double end_time, StaticStatus status) {
  // The rigid model has no bolts.
  if (std::any_of(run.state.bolts.begin(), run.state.bolts.end(),
                  [](const BoltState& bolt) { return bolt.installed(); }))
    return status;
  if (!can_tell(run, end_time)) return verdict_on_level(run, status);
  if (status == StaticStatus::equilibrium && !is_where_placed(run)) return status;
  const RunState placed = as_placed(run);
  RigidModel model = rigid_model(run.system, placed, end_time, {});
  if (loses_strength(model) || model.bodies.empty()) return status;
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return false; }, run.settings().threads);
  const LimitTrial trial = analysis.released({});
  // Blocks are in balance on contacts where rigid blocks have no forces: the rigid model is inconclusive.
  if (status == StaticStatus::equilibrium && !trial.balanced) return status;
  if (trial.outcome == LimitOutcome::moves) {
    note_motion(run, analysis.motion_of(trial));
    return StaticStatus::moving;
  }
  if (trial.outcome != LimitOutcome::stands || status == StaticStatus::equilibrium ||
      !is_rigid(run, analysis.model()))
    return status;
  // Rigid blocks under forces in balance are in equilibrium at their initial placement.
  for (std::size_t k = 0; k < placed.states.size(); ++k)
    run.state.states[k].position = run.blocks()[k].initial_state().position;
  std::vector<Eigen::Vector3d> forces = trial.force;
  for (Eigen::Vector3d& force : forces) force *= analysis.model().units.force();
  run.state.records = contact_records(analysis.model(), forces);
  run.state.statics.balanced = true;
  run.state.statics.moving = false;
  run.state.clock = {.start = end_time};
  return StaticStatus::equilibrium;
}

}  // namespace ashlar

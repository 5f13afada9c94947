#include "solver/statics/rigid_verdict.hpp"

#include <algorithm>

#include "geometry/index.hpp"
#include "solver/state/automatic.hpp"
#include "solver/statics/limit_analysis.hpp"

namespace ashlar {
namespace {

/// Blocks that lie elsewhere than they were placed have found their place.
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
    return block.driven() || block.loads_change_between(0.0, end_time);
  });
}

/// Whether neither blocks nor joints give way.
bool is_rigid(const RunContext& run, const RigidModel& model) {
  for (std::size_t k = 0; k < run.blocks().size(); ++k)
    if (run.system.moving()[k] && !run.blocks()[k].rigid()) return false;
  return std::all_of(model.points.begin(), model.points.end(),
                     [](const RigidPoint& point) { return point.law.rigid; });
}

/// The rigid motion of a block as a field of its functions. @return (p, 3)
Eigen::MatrixX3d field_of(const BlockModel& block, const Eigen::MatrixX3d& position,
                          const LimitMotion::Block& motion) {
  Eigen::VectorXd one = Eigen::VectorXd::Zero(position.rows());
  one[0] = std::sqrt(block.basis().volume());  // the first function is constant and of norm 1
  const Vector3& w = motion.angular_acceleration;
  Eigen::Matrix3d turn;
  turn << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return one * motion.acceleration.transpose() +
         (position - one * motion.about.transpose()) * turn.transpose();
}

void note_motion(const RunContext& run, const LimitMotion& motion) {
  StaticState& statics = run.state.statics;
  const std::size_t count = run.blocks().size();
  statics.moving = true;
  statics.balanced = false;
  statics.progress.travels.assign(count, 0.0);
  statics.onset.unbalanced.assign(count, Eigen::MatrixX3d());
  for (std::size_t k = 0; k < count; ++k)
    statics.onset.unbalanced[k].setZero(run.state.states[k].position.rows(), 3);
  statics.onset.rigid = true;
  for (const LimitMotion::Block& block : motion.blocks) {
    const std::size_t k = at(block.block);
    statics.progress.travels[k] = run.settings().statics.travel;
    statics.onset.unbalanced[k] = field_of(run.blocks()[k], run.state.states[k].position, block);
  }
}

}  // namespace

StaticStatus rigid_verdict(const RunContext& run, double end_time, StaticStatus status) {
  if (!can_tell(run, end_time)) return status;
  if (status == StaticStatus::equilibrium && !is_where_placed(run)) return status;
  RunState placed;
  for (const BlockModel& block : run.blocks()) placed.states.push_back(block.initial_state());
  for (const auto& [blocks, history] : run.state.pairs) placed.pairs[blocks].overlap = history.overlap;
  RigidModel model = rigid_model(run.system, placed, end_time, {});
  const bool weakens = std::any_of(model.points.begin(), model.points.end(), [](const RigidPoint& point) {
    return point_law(point.law, 1.0, true).weakens();
  });
  if (weakens || model.bodies.empty()) return status;
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return false; }, run.settings().threads);
  // Where blocks are in balance on contacts that rigid blocks have no forces for, these tell nothing.
  if (status == StaticStatus::equilibrium && analysis.associated({}).outcome != LimitOutcome::stands)
    return status;
  const LimitTrial trial = analysis.released({});
  if (trial.outcome == LimitOutcome::moves) {
    note_motion(run, analysis.motion_of(trial));
    return StaticStatus::moving;
  }
  if (trial.outcome != LimitOutcome::stands || status == StaticStatus::equilibrium ||
      !is_rigid(run, analysis.model()))
    return status;
  // Rigid blocks under forces in balance are in equilibrium where they were placed.
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

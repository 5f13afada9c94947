#include "solver/statics/motion_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/index.hpp"
#include "mechanics/basis/field_moments.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/static_verdict.hpp"

namespace ashlar {
namespace {

constexpr double least_share_of_load = 1e-6;  // of the acceleration by a force that acts on the block
/// The same, which blocks that are nearly rigid still yield at their onset (rigid_onset.cpp).
constexpr double compliant_share = 1e-3;
constexpr double opposing_share =
    0.1;  // of the power of forces that would act along the fastest acceleration
/// The same for accelerations that are next to none: a block that tips over its edge is opposed by rounding alone.
constexpr double opposing_share_of_sway = 1e-3;

/// Power of the normal forces of contacts per acceleration, N: what resists, and the most that could.
struct ContactPower {
  double resisting = 0.0;
  double most = 0.0;
};

/// Acceleration of a material point, m/s^2.
Vector3 acceleration_at(const BlockSystem& system, const RunState& state, int block, const Vector3& point) {
  const Eigen::MatrixX3d& field = state.statics.onset.unbalanced[at(block)];
  if (field.rows() == 0) return Vector3::Zero();
  return field.transpose() * system.blocks()[at(block)].basis().values(point);
}

/// @param fastest m/s^2, of all moving blocks
ContactPower power_of(const BlockSystem& system, const RunState& state, const PairRecord& pair,
                      double fastest) {
  ContactPower power;
  for (std::size_t k = 0; k < pair.points.size(); ++k) {
    const ContactPoint& point = pair.points[k];
    const double force = pair.responses[k].force[0];
    if (pair.responses[k].state == ContactState::open || !(force > 0.0)) continue;
    // The normal force acts on block a along the normal.
    const Vector3 apart = acceleration_at(system, state, pair.a, point.material_a) -
                          acceleration_at(system, state, pair.b, point.material_b);
    power.resisting += force * std::max(0.0, -apart.dot(point.normal));
    power.most += force * fastest;
  }
  return power;
}

}  // namespace

MotionDoubt doubt_of_motion(const BlockSystem& system, const RunState& state) {
  const MovingBlocks moving = moving_blocks(system, state);
  double fastest = 0.0, by_forces = 0.0;
  std::vector<bool> goes(system.blocks().size(), false);
  for (const MovingBlock& block : moving.first) {
    goes[at(block.block)] = true;
    const BlockModel& model = system.blocks()[at(block.block)];
    fastest = std::max(fastest, mean_motion(model, state.statics.onset.unbalanced[at(block.block)]));
    by_forces = std::max(by_forces, system.settings().largest_gravity());
  }
  // A contact of a block that goes may belong to another process.
  goes = any_of_run(system, goes);
  if (std::none_of(goes.begin(), goes.end(), [](bool of_block) { return of_block; }))
    return MotionDoubt::none;
  fastest = most_of_run(system, fastest);
  ContactPower power;
  for (const PairRecord& pair : state.records) {
    if (!system.owns_pair(pair.a, pair.b) || !(goes[at(pair.a)] || goes[at(pair.b)])) continue;
    const ContactPower of_pair = power_of(system, state, pair, fastest);
    power.resisting += of_pair.resisting;
    power.most += of_pair.most;
    for (const int block : {pair.a, pair.b}) {
      if (!goes[at(block)] || !(fastest > 0.0)) continue;
      by_forces = std::max(by_forces, of_pair.most / fastest / system.blocks()[at(block)].mass());
    }
  }
  const double opposed = sum_of_run(system, power.resisting), most = sum_of_run(system, power.most);
  const double share = fastest / most_of_run(system, by_forces);
  if ((share < compliant_share && opposed > opposing_share * most) ||
      (share < least_share_of_load && opposed > opposing_share_of_sway * most))
    return MotionDoubt::no_acceleration;
  const bool used_up = state.statics.iterations >= system.settings().statics.iterations;
  return used_up && opposed > opposing_share * most ? MotionDoubt::opposed : MotionDoubt::none;
}

}  // namespace ashlar

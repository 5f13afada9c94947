#include "solver/step/slowed_slip.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Of its normal force, what a point's impulse is at most: a normal that turns by more in a step is not why
/// it is deep.
constexpr double largest_lean = 0.1;

}  // namespace

PairResponse ContactPair::against_slip(double depth, const Eigen::VectorXd& ya,
                                       const Eigen::VectorXd& yb) const {
  const Eigen::Matrix3Xd motion = relative(ya, yb) - start_;
  PairResponse result;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(motion.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    MeanResponse mean{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector2d::Zero(), 0.0};
    if (laws_[k].tension == 0.0 && points_[k].gap < -depth)
      mean.force.tail<2>() = -start_responses_[k].force[0] * motion.col(column).tail<2>();
    forces.segment<3>(3 * column) = mean.force;
    result.means.push_back(mean);
  }
  result.points = start_responses_;
  set_block_forces(forces, result);
  return result;
}

std::optional<SlowedSlip> slow_slip(const RunContext& run, const Island& island,
                                    const std::vector<ContactPair>& pairs, double step, double energy) {
  const double depth = run.settings().multipliers.share * run.settings().multipliers.penetration_tolerance;
  std::vector<Eigen::VectorXd> slips(run.blocks().size());  // velocities of the unknowns
  std::vector<Eigen::MatrixX3d> prescribed(run.blocks().size());
  for (const int k : island.bodies) {
    const BlockModel& block = run.blocks()[at(k)];
    slips[at(k)] = block.space().restrict(run.state.states[at(k)].velocity);
    Eigen::MatrixX3d of_supports = run.state.states[at(k)].velocity - block.space().expand(slips[at(k)]);
    if (!of_supports.isZero(0.0)) prescribed[at(k)] = std::move(of_supports);
  }
  SlowedSlip slowed;
  std::map<int, Eigen::VectorXd> sums;
  double power = 0.0;    // of s = 1, J/s
  double fastest = 0.0;  // m/s
  for (const int index : island.pairs) {
    if (pairs[at(index)].tied() || pairs[at(index)].depth_found() <= depth) continue;
    ContactPair pair = pairs[at(index)];
    const auto [a, b] = std::array{pair.a(), pair.b()};
    pair.prescribe(run.blocks()[at(a)], prescribed[at(a)], run.blocks()[at(b)], prescribed[at(b)]);
    const PairResponse response = pair.against_slip(depth, slips[at(a)], slips[at(b)]);
    const auto push = [&](int block, const Eigen::VectorXd& force) {
      if (force.size() == 0) return;
      Eigen::VectorXd& sum = sums.try_emplace(block, Eigen::VectorXd::Zero(force.size())).first->second;
      sum += force;
      power -= force.dot(slips[at(block)]);
    };
    push(a, response.force_on_a);
    push(b, response.force_on_b);
    power -= pair.prescribed_work(response);
    slowed.work_on_supports += pair.prescribed_work(response);
    Vector3& on_a = slowed.on_a.try_emplace({a, b}, Vector3::Zero()).first->second;
    for (std::size_t n = 0; n < response.means.size(); ++n) {
      const auto force = response.means[n].force.tail<2>();
      if (force.isZero(0.0)) continue;
      fastest = std::max(fastest, force.norm() / response.points[n].force[0]);
      on_a += force[0] * pair.points()[n].tangent_1 + force[1] * pair.points()[n].tangent_2;
    }
  }
  double resistance = 0.0;
  for (const auto& [block, sum] : sums)
    resistance += sum.squaredNorm() / run.blocks()[at(block)].material().density;
  const double left = power * power - 2.0 * resistance * energy;
  if (power <= 0.0 || left < 0.0) return std::nullopt;
  const double scale = 2.0 * energy / (power + std::sqrt(left));
  if (scale * fastest > largest_lean * step) return std::nullopt;
  slowed.work_on_supports *= scale;
  for (auto& [pair, impulse] : slowed.on_a) impulse *= scale;
  for (const auto& [block, sum] : sums)
    slowed.velocities[block] =
        run.blocks()[at(block)].space().expand(scale / run.blocks()[at(block)].material().density * sum);
  return slowed;
}

void apply(const RunContext& run, const SlowedSlip& slowed, std::map<PairKey, Vector3>& impulses) {
  LedgerKeeper& ledger = run.state.ledger;
  for (const auto& [block, change] : slowed.velocities) {
    BlockState& state = run.state.states[at(block)];
    ledger.integrator_took(run.blocks()[at(block)].kinetic_energy(state));
    state.velocity += change;
    ledger.integrator_took(-run.blocks()[at(block)].kinetic_energy(state));
  }
  ledger.integrator_took(-slowed.work_on_supports);
  ledger.loads_did(-slowed.work_on_supports);
  for (const auto& [pair, impulse] : slowed.on_a)
    impulses.try_emplace(pair, Vector3::Zero()).first->second += impulse;
}

void add_impulse(const Vector3& on_a, double step, const std::vector<ContactPoint>& points,
                 std::vector<PointResponse>& forces) {
  double pushes = 0.0;
  for (const PointResponse& point : forces) pushes += std::max(0.0, point.force[0]);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double share =
        pushes > 0.0 ? std::max(0.0, forces[k].force[0]) / pushes : 1.0 / static_cast<double>(points.size());
    const Vector3 force = share / step * on_a;
    const ContactPoint& point = points[k];
    forces[k].force +=
        Vector3(point.normal.dot(force), point.tangent_1.dot(force), point.tangent_2.dot(force));
  }
}

}  // namespace ashlar

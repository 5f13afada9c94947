#include "solver/run/order_error.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/index.hpp"
#include "mechanics/block/order_change.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

int largest_order(const BlockModel& block) {
  return block.tangent_turns() ? PolynomialBasis::max_order : StVenantKirchhoff::max_order;
}

/// A solution that is even or odd has nothing in the next order.
constexpr int further_orders = 2;

double relative_of(double lacks, double energy) {
  return lacks > 0.0 ? std::sqrt(lacks / (energy + lacks)) : 0.0;
}

/// Forces at material points of a block.
struct PointForces {
  std::vector<Vector3> points;  ///< reference coordinates, m
  std::vector<Vector3> forces;  ///< N

  void add(const Vector3& point, const Vector3& force) {
    points.push_back(point);
    forces.push_back(force);
  }
  /// @return (p, 3), N m^-3/2
  [[nodiscard]] Eigen::MatrixX3d on(const PolynomialBasis& basis) const {
    Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(basis.size(), 3);
    if (points.empty()) return sum;
    Eigen::MatrixX3d rows(static_cast<Eigen::Index>(forces.size()), 3);
    for (std::size_t k = 0; k < forces.size(); ++k) rows.row(static_cast<Eigen::Index>(k)) = forces[k];
    return basis.values(points).transpose() * rows;
  }
};

std::vector<PointForces> contact_forces(const Simulation& simulation) {
  std::vector<PointForces> forces(simulation.blocks().size());
  for (const PairRecord& record : simulation.contacts()) {
    for (std::size_t k = 0; k < record.points.size(); ++k) {
      const ContactPoint& point = record.points[k];
      const Vector3 force = out_of_frame(point, record.responses[k].force);
      forces[at(record.a)].add(point.material_a, force);
      forces[at(record.b)].add(point.material_b, -force);
    }
  }
  return forces;
}

/// The part of a force on functions of the higher order that those of the lower one do not have, in the unknowns.
Eigen::VectorXd higher_part(const BlockModel& low, const BlockModel& high, const Eigen::MatrixX3d& force) {
  const Eigen::Index shared = low.basis().size();
  Eigen::MatrixX3d rest = high.space().expand(high.space().restrict(force));
  rest.topRows(shared) -= low.space().expand(low.space().restrict(Eigen::MatrixX3d(force.topRows(shared))));
  return high.space().restrict(rest);
}

OrderError error_of(const Simulation& simulation, int index, const PointForces& contact) {
  const BlockModel& block = simulation.blocks()[at(index)];
  const BlockState& state = simulation.states()[at(index)];
  const BlockModel high = block.with_order(std::min(block.order() + further_orders, largest_order(block)));
  const Eigen::MatrixX3d position = change_order(block, state, high).state.position;
  const ElasticResponse elastic = high.elastic(position);
  const Vector3 gravity = simulation.system().settings().gravity_at(simulation.time());
  const Eigen::MatrixX3d outer = high.external_force(gravity, simulation.time()) + contact.on(high.basis());
  const Eigen::VectorXd residual = higher_part(block, high, outer - elastic.force);
  OrderError error{index, block.elastic(state.position).energy, 0.0};
  // Sums of forces are rounded; a block without them has no error.
  constexpr double rounding = 1e-11;
  if (!(residual.norm() > rounding * outer.norm() + high.force_rounding())) return error;
  Eigen::MatrixXd stiffness = high.tangent(position, elastic, true);
  // Rigid motions, which the residual does not contain, have no stiffness.
  constexpr double of_largest = 1e-12;
  stiffness.diagonal().array() += of_largest * stiffness.diagonal().maxCoeff();
  const double squared = residual.dot(stiffness.ldlt().solve(residual));
  if (squared > 0.0) error.lacks = 0.5 * squared;
  return error;
}

}  // namespace

double OrderError::relative() const {
  return relative_of(lacks, energy);
}

std::vector<OrderError> order_errors(const Simulation& simulation) {
  std::set<int> bolted;
  for (const Bolt& bolt : simulation.system().bolts())
    for (const BoltSpan& span : bolt.chain.shape().pieces()) bolted.insert(span.block);
  std::vector<OrderError> errors;
  for (int k = 0; k < static_cast<int>(simulation.blocks().size()); ++k) {
    const BlockModel& block = simulation.blocks()[at(k)];
    if (!simulation.system().moving()[at(k)] || block.rigid() || block.incremental() != nullptr ||
        block.quiet() || block.driven() || block.initial_stress() || simulation.system().is_tied(k) ||
        block.order() >= largest_order(block) || bolted.contains(k))
      continue;
    errors.push_back({k});
  }
  const std::vector<PointForces> forces = contact_forces(simulation);
  parallel_for(simulation.system().settings().threads, errors.size(), [&](std::size_t k) {
    errors[k] = error_of(simulation, errors[k].block, forces[at(errors[k].block)]);
  });
  return errors;
}

double relative_error(const std::vector<OrderError>& errors) {
  double lacks = 0.0, energy = 0.0;
  for (const OrderError& error : errors) {
    lacks += error.lacks;
    energy += error.energy;
  }
  return relative_of(lacks, energy);
}

}  // namespace ashlar

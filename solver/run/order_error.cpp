#include "solver/run/order_error.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "geometry/index.hpp"
#include "mechanics/block/order_change.hpp"
#include "mechanics/contact/tie.hpp"
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

/// Empty if the shape or the material of the block excludes the order, or if it is that of the block.
std::optional<BlockModel> allowed_order(const BlockModel& block, int order) {
  if (order <= block.order()) return std::nullopt;
  try {
    return block.with_order(order);
  } catch (const OrderTooHigh&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
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

/// Force of ties on a block, with the size of its rounding errors.
struct TieForce {
  Eigen::MatrixX3d force;  ///< (p, 3), N m^-3/2
  double rounding = 0.0;   ///< N m^-3/2
};

/// @param high the block with functions of higher order, at a position
TieForce tie_force(const Simulation& simulation, int index, const BlockModel& high,
                   const Eigen::MatrixX3d& position) {
  TieForce sum{Eigen::MatrixX3d::Zero(high.basis().size(), 3), 0.0};
  for (const TiedBlocks& tied : simulation.system().ties()) {
    if (tied.a != index && tied.b != index) continue;
    const int other = tied.a == index ? tied.b : tied.a;
    const BlockModel& block = simulation.blocks()[at(other)];
    const Eigen::MatrixX3d& there = simulation.states()[at(other)].position;
    // In the order in which the blocks were tied: the common area of faces that meet in an edge is rounding, and may be
    // zero in the other order.
    const bool first = tied.a == index;
    const Tie tie = first ? tie_between(high.solid(), high.basis(), block.solid(), block.basis())
                          : tie_between(block.solid(), block.basis(), high.solid(), high.basis());
    const Eigen::MatrixXd &own = first ? tie.a : tie.b, &others = first ? tie.b : tie.a;
    if (own.rows() == 0) continue;
    sum.force -= tied.stiffness * (own.transpose() * (own * position - others * there));
    // The gap is a small difference of large places.
    const double places = own.norm() * position.norm() + others.norm() * there.norm();
    sum.rounding += tied.stiffness * own.norm() * places * std::numeric_limits<double>::epsilon();
  }
  return sum;
}

/// Empty: the shape of the block allows no higher order.
std::optional<OrderError> error_of(const Simulation& simulation, int index, const PointForces& contact) {
  const BlockModel& block = simulation.blocks()[at(index)];
  const BlockState& state = simulation.states()[at(index)];
  const std::optional<BlockModel> higher = with_further_orders(block);
  if (!higher) return std::nullopt;
  const BlockModel& high = *higher;
  const Eigen::MatrixX3d position = change_order(block, state, high).state.position;
  const ElasticResponse elastic = high.elastic(position);
  const Vector3 gravity = simulation.system().settings().gravity_at(simulation.time());
  const TieForce ties = tie_force(simulation, index, high, position);
  const Eigen::MatrixX3d outer =
      high.external_force(gravity, simulation.time()) + contact.on(high.basis()) + ties.force;
  const Eigen::VectorXd residual = part_on_new_functions(block, high, outer - elastic.force);
  OrderError error{index, block.elastic(state.position).energy, 0.0};
  // Sums of forces are rounded; a block without them has no error.
  constexpr double rounding = 1e-11;
  if (!(residual.norm() > rounding * outer.norm() + high.force_rounding() + ties.rounding)) return error;
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

std::optional<BlockModel> with_further_orders(const BlockModel& block) {
  if (block.fixed() || block.rigid() || block.incremental() != nullptr || block.dashpots() != nullptr)
    return std::nullopt;
  const int largest = largest_order(block);
  const int wanted = std::min(block.order() + further_orders, largest);
  std::optional<BlockModel> next = allowed_order(block, wanted);
  for (int order = wanted - 1; !next && order > block.order(); --order) next = allowed_order(block, order);
  for (int order = wanted + 1; next && next->unknowns() == 0 && order <= largest; ++order)
    next = allowed_order(block, order);
  return next;
}

Eigen::VectorXd part_on_new_functions(const BlockModel& low, const BlockModel& high,
                                      const Eigen::MatrixX3d& force) {
  const Eigen::Index shared = low.basis().size();
  Eigen::MatrixX3d rest = high.space().expand(high.space().restrict(force));
  rest.topRows(shared) -= low.space().expand(low.space().restrict(Eigen::MatrixX3d(force.topRows(shared))));
  return high.space().restrict(rest);
}

std::vector<OrderError> order_errors(const Simulation& simulation) {
  std::set<int> bolted;
  for (const Bolt& bolt : simulation.system().bolts())
    for (const BoltSpan& span : bolt.chain.shape().pieces()) bolted.insert(span.block);
  std::vector<int> asked;
  for (int k = 0; k < static_cast<int>(simulation.blocks().size()); ++k) {
    const BlockModel& block = simulation.blocks()[at(k)];
    if (!simulation.system().moving()[at(k)] || block.rigid() || block.incremental() != nullptr ||
        block.quiet() || block.driven() || block.initial_stress() || block.order() >= largest_order(block) ||
        bolted.contains(k))
      continue;
    asked.push_back(k);
  }
  const std::vector<PointForces> forces = contact_forces(simulation);
  std::vector<std::optional<OrderError>> found(asked.size());
  parallel_for(simulation.system().settings().threads, asked.size(),
               [&](std::size_t k) { found[k] = error_of(simulation, asked[k], forces[at(asked[k])]); });
  std::vector<OrderError> errors;
  for (const std::optional<OrderError>& error : found)
    if (error) errors.push_back(*error);
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

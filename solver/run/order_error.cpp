#include "solver/run/order_error.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "geometry/index.hpp"
#include "mechanics/block/order_change.hpp"
#include "mechanics/contact/laws/tie.hpp"
#include "solver/parallel_for.hpp"
#include "solver/run/order_error_work.hpp"

namespace ashlar {
namespace {

int largest_order(const BlockModel& block) {
  return block.tangent_turns() ? PolynomialBasis::max_order : StVenantKirchhoff::max_order;
}

/// A solution that is even or odd has nothing in the next order.
constexpr int further_orders = 2;

/// Of sums of forces.
constexpr double relative_rounding = 1e-11;
/// Stiffness of rigid motions, which the residual does not contain, of the largest one: smaller values leave their matrix
/// singular, larger ones reduce the error that is estimated.
constexpr double stiffness_of_rigid_motion = 1e-12;

/// The order that is tried first.
int wanted_order(const BlockModel& block) {
  return std::min(block.order() + further_orders, largest_order(block));
}

double relative_of(double missing_energy, double energy) {
  return missing_energy > 0.0 ? std::sqrt(missing_energy / (energy + missing_energy)) : 0.0;
}

/// Empty if the shape or the material of the block excludes the order, or if it is that of the block.
std::optional<BlockModel> allowed_order(const BlockModel& block, int order, BlockPartsLibrary& library) {
  if (order <= block.order()) return std::nullopt;
  try {
    return block.with_order(order, library);
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
  double sum_of_sizes = 0.0;    ///< N

  void add(const Vector3& point, const Vector3& force) {
    points.push_back(point);
    forces.push_back(force);
    sum_of_sizes += force.norm();
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

/// A block that can be estimated, with what is known of it without any higher order.
struct Candidate {
  int block;
  double energy;  ///< of strain, J
  /// Size of its contact forces, loads and elastic forces, N: ties and inertia are in the last ones
  double force;
  bool undeformed;  ///< and without forces but gravity: it has no error
};

Candidate candidate_of(const Simulation& simulation, int index, const PointForces& contact) {
  const BlockSystem& system = simulation.system();
  const BlockModel& block = simulation.blocks()[at(index)];
  const ElasticResponse elastic = block.elastic(simulation.states()[at(index)].position);
  const double load = block.load_force(simulation.time()).norm(), stress = elastic.force.norm();
  const auto within_rounding = [&] {
    const Vector3 gravity = system.settings().gravity_at(simulation.time());
    return stress <= relative_rounding * block.external_force(gravity, simulation.time()).norm() +
                         block.force_rounding();
  };
  const bool free =
      contact.sum_of_sizes == 0.0 && load == 0.0 && !block.supported() && !system.is_tied(index);
  const double force = contact.sum_of_sizes + std::sqrt(block.basis().volume()) * (load + stress);
  return {index, elastic.energy, force, free && within_rounding()};
}

/// @param high the block with the functions of the next orders
OrderError error_of(const Simulation& simulation, const Candidate& candidate, const BlockModel& high,
                    const PointForces& contact) {
  const int index = candidate.block;
  const BlockModel& block = simulation.blocks()[at(index)];
  const BlockState& state = simulation.states()[at(index)];
  const Eigen::MatrixX3d position = change_order(block, state, high).state.position;
  const ElasticResponse elastic = high.elastic(position);
  const Vector3 gravity = simulation.system().settings().gravity_at(simulation.time());
  const TieForce ties = tie_force(simulation, index, high, position);
  const Eigen::MatrixX3d outer =
      high.external_force(gravity, simulation.time()) + contact.on(high.basis()) + ties.force;
  const Eigen::VectorXd residual = part_on_new_functions(block, high, outer - elastic.force);
  OrderError error{index, candidate.energy, 0.0};
  // Sums of forces are rounded; a block without them has no error.
  if (!(residual.norm() > relative_rounding * outer.norm() + high.force_rounding() + ties.rounding))
    return error;
  Eigen::MatrixXd stiffness = high.tangent(position, elastic, true);
  stiffness.diagonal().array() += stiffness_of_rigid_motion * stiffness.diagonal().maxCoeff();
  const double squared = residual.dot(stiffness.ldlt().solve(residual));
  if (squared > 0.0) error.missing_energy = 0.5 * squared;
  return error;
}

/// Blocks that the estimate is for.
std::vector<int> blocks_to_estimate(const Simulation& simulation) {
  const BlockSystem& system = simulation.system();
  std::set<int> bolted;
  for (const Bolt& bolt : system.bolts())
    for (const BoltSpan& span : bolt.chain.shape().pieces()) bolted.insert(span.block);
  std::vector<int> result;
  for (int k = 0; k < static_cast<int>(simulation.blocks().size()); ++k) {
    const BlockModel& block = simulation.blocks()[at(k)];
    if (!system.moving()[at(k)] || block.rigid() || block.incremental() != nullptr || block.quiet() ||
        block.driven() || block.initial_stress() || block.order() >= largest_order(block) ||
        bolted.contains(k))
      continue;
    result.push_back(k);
  }
  return result;
}

/// Indices of the candidates with the largest forces whose estimates fit into a budget, in increasing order.
std::vector<int> chosen_within(const Simulation& simulation, const std::vector<Candidate>& candidates,
                               double most_work) {
  std::vector<int> ranked(candidates.size());
  std::iota(ranked.begin(), ranked.end(), 0);
  std::erase_if(ranked, [&](int k) { return candidates[at(k)].undeformed; });
  std::stable_sort(ranked.begin(), ranked.end(),
                   [&](int a, int b) { return candidates[at(a)].force > candidates[at(b)].force; });
  EstimateBudget budget(most_work);
  std::vector<int> chosen;
  for (const int k : ranked) {
    const BlockModel& block = simulation.blocks()[at(candidates[at(k)].block)];
    if (budget.take(block, wanted_order(block))) chosen.push_back(k);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

double OrderError::relative() const {
  return relative_of(missing_energy, energy);
}

std::optional<BlockModel> with_further_orders(const BlockModel& block) {
  BlockPartsLibrary library;
  return with_further_orders(block, library);
}

std::optional<BlockModel> with_further_orders(const BlockModel& block, BlockPartsLibrary& library) {
  if (block.fixed() || block.rigid() || block.incremental() != nullptr || block.dashpots() != nullptr)
    return std::nullopt;
  const int largest = largest_order(block), wanted = wanted_order(block);
  std::optional<BlockModel> next = allowed_order(block, wanted, library);
  for (int order = wanted - 1; !next && order > block.order(); --order)
    next = allowed_order(block, order, library);
  for (int order = wanted + 1; next && next->unknowns() == 0 && order <= largest; ++order)
    next = allowed_order(block, order, library);
  return next;
}

Eigen::VectorXd part_on_new_functions(const BlockModel& low, const BlockModel& high,
                                      const Eigen::MatrixX3d& force) {
  const Eigen::Index shared = low.basis().size();
  Eigen::MatrixX3d rest = high.space().expand(high.space().restrict(force));
  rest.topRows(shared) -= low.space().expand(low.space().restrict(Eigen::MatrixX3d(force.topRows(shared))));
  return high.space().restrict(rest);
}

OrderErrors order_errors_within(const Simulation& simulation, double most_work) {
  const int threads = simulation.system().settings().threads;
  const std::vector<PointForces> forces = contact_forces(simulation);
  const std::vector<int> asked = blocks_to_estimate(simulation);
  std::vector<Candidate> candidates(asked.size());
  parallel_for(threads, asked.size(), [&](std::size_t k) {
    candidates[k] = candidate_of(simulation, asked[k], forces[at(asked[k])]);
  });
  std::vector<std::optional<OrderError>> found(asked.size());
  OrderErrors result;
  result.blocks = static_cast<int>(asked.size());
  std::vector<int> chosen;                                           // blocks
  std::vector<std::size_t> place_of(simulation.blocks().size(), 0);  // by block, in `found`
  for (const int k : chosen_within(simulation, candidates, most_work)) {
    chosen.push_back(asked[at(k)]);
    place_of[at(asked[at(k)])] = at(k);
  }
  const std::vector<std::vector<int>> groups = equal_blocks(simulation.blocks(), chosen);
  parallel_for(threads, groups.size(), [&](std::size_t n) {
    BlockPartsLibrary library;
    int order = 0;  // of the first block's estimate, and so of all
    for (const int block : groups[n]) {
      const BlockModel& model = simulation.blocks()[at(block)];
      const std::optional<BlockModel> high =
          order > 0 ? allowed_order(model, order, library) : with_further_orders(model, library);
      if (!high) continue;
      order = high->order();
      const std::size_t k = place_of[at(block)];
      found[k] = error_of(simulation, candidates[k], *high, forces[at(block)]);
    }
  });
  // The shape of others allows no higher order.
  for (const int block : chosen) result.blocks -= found[place_of[at(block)]] ? 0 : 1;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (candidates[k].undeformed) found[k] = OrderError{candidates[k].block, candidates[k].energy, 0.0};
    if (found[k]) result.errors.push_back(*found[k]);
  }
  return result;
}

std::vector<OrderError> order_errors(const Simulation& simulation) {
  return order_errors_within(simulation, std::numeric_limits<double>::infinity()).errors;
}

double relative_error(const std::vector<OrderError>& errors) {
  double missing = 0.0, energy = 0.0;
  for (const OrderError& error : errors) {
    missing += error.missing_energy;
    energy += error.energy;
  }
  return relative_of(missing, energy);
}

}  // namespace ashlar

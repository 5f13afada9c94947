#include "solver/accuracy/goal_error.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/block/order_change.hpp"
#include "solver/accuracy/goal_distance.hpp"
#include "solver/parallel_for.hpp"
#include "solver/run/order_error.hpp"
#include "solver/run/order_error_work.hpp"
#include "solver/step/accept/snapshot.hpp"
#include "solver/step/island/island_tangent.hpp"
#include "solver/step/step_problem.hpp"

namespace ashlar {
namespace {

/// Of the springs of points with multipliers, which stand for contact without compliance.
constexpr double stiffer_than_springs = 1e3;

/// The blocks with their next orders; those that have none as they are. Empty: no block has any.
std::vector<BlockModel> with_next_orders(const Simulation& simulation) {
  const std::vector<BlockModel>& blocks = simulation.blocks();
  std::vector<std::optional<BlockModel>> higher(blocks.size());
  std::vector<int> moving;
  for (std::size_t k = 0; k < blocks.size(); ++k)
    if (simulation.system().moving()[k]) moving.push_back(static_cast<int>(k));
  const std::vector<std::vector<int>> groups = equal_blocks(blocks, moving);
  parallel_for(simulation.system().settings().threads, groups.size(), [&](std::size_t n) {
    BlockPartsLibrary library;
    for (const int k : groups[n]) higher[at(k)] = with_further_orders(blocks[at(k)], library);
  });
  std::vector<BlockModel> result;
  bool any = false;
  int unknowns = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    any = any || higher[k].has_value();
    if (higher[k])
      result.push_back(std::move(*higher[k]));
    else
      result.push_back(blocks[k]);
    if (simulation.system().moving()[k]) unknowns += result.back().unknowns();
  }
  return any && unknowns <= largest_goal_system ? std::move(result) : std::vector<BlockModel>{};
}

/// The same blocks with other models, in the same state, without the memory of their contacts.
/// @param simulation must outlive it
Simulation with_models(const Simulation& simulation, std::vector<BlockModel> models,
                       SimulationSnapshot present) {
  const BlockSystem& system = simulation.system();
  for (std::size_t k = 0; k < models.size(); ++k)
    if (models[k].order() != system.blocks()[k].order())
      present.run.states[k] = change_order(system.blocks()[k], present.run.states[k], models[k]).state;
  std::vector<TieRequest> ties;
  for (const TiedBlocks& tie : system.ties()) ties.push_back({tie.a, tie.b, tie.stiffness});
  const std::vector<InitialMotion> at_rest(models.size());
  Simulation result(
      std::move(models), at_rest, [&system](int a, int b) { return system.law(a, b); }, system.settings(),
      ties, system.absent());
  if (!system.bolts().empty()) result.add_bolts(system.bolts());
  present.finder = result.snapshot().finder;
  present.factors.clear();
  result.restore(present);
  return result;
}

bool has_multipliers(const BlockSystem& system, const PairRecord& record) {
  return system.law(record.a, record.b).has_multipliers();
}

/// The one system of equations of the corrected blocks.
class Correction {
 public:
  /// @param present,higher the same blocks in the same state
  Correction(const Simulation& present, Simulation& higher)
      : present_(present), higher_(higher), snapshot_(higher.snapshot()) {
    pose();
  }

  /// Moves the blocks by d and sets their contact forces. @return false if there is no such d
  bool apply() {
    for (const Island& island : problem_.islands)
      if (!solve(island)) return false;
    RunState& state = snapshot_.run;
    for (std::size_t k = 0; k < state.states.size(); ++k)
      if (higher_.system().moving()[k]) state.states[k].position += problem_.bodies[k].motion();
    higher_.restore(snapshot_);
    return true;
  }

 private:
  void pose() {
    const BlockSystem& system = higher_.system();
    const RunState& state = snapshot_.run;
    const auto body = [&](int k) {
      return ContactBody{&system.blocks()[at(k)], &state.states[at(k)], nullptr};
    };
    for (std::size_t k = 0; k < state.records.size(); ++k) {
      const PairRecord& record = state.records[k];
      if (!system.moving()[at(record.a)] && !system.moving()[at(record.b)]) continue;
      record_of_[problem_.pairs.size()] = k;
      problem_.pairs.emplace_back(PairBodies{record.a, record.b, body(record.a), body(record.b)},
                                  system.law(record.a, record.b), ContactPatch{record.points},
                                  std::vector<PointMemory>(record.points.size()));
    }
    for (const TiedBlocks& tied : system.ties())
      if (system.moving()[at(tied.a)] || system.moving()[at(tied.b)])
        problem_.pairs.emplace_back(PairBodies{tied.a, tied.b, body(tied.a), body(tied.b)}, tied.tie,
                                    tied.stiffness);
    TimeScheme scheme;
    scheme.kind = StepKind::statics;
    scheme.inertia = state.statics.inertia;
    pose_step(system, state, scheme, problem_);
  }

  /// The forces of the last step, with the stiffnesses of its points.
  [[nodiscard]] PairResponse recorded(std::size_t pair_index) const {
    const PairRecord& record = snapshot_.run.records[record_of_.at(pair_index)];
    const ContactPair& pair = problem_.pairs[pair_index];
    const double factor = has_multipliers(higher_.system(), record) ? stiffer_than_springs : 1.0;
    PairResponse response;
    response.points = record.responses;
    Eigen::VectorXd forces(3 * static_cast<Eigen::Index>(record.responses.size()));
    for (std::size_t k = 0; k < record.responses.size(); ++k) {
      PointResponse& point = response.points[k];
      point.tangent *= factor;
      point.coupling.force *= factor;
      forces.segment<3>(3 * static_cast<Eigen::Index>(k)) = point.force;
      response.means.push_back({point.force, point.tangent, point.coupling, 0.0});
    }
    pair.rows().set_forces(forces, response);
    pair.rows().set_shifts(Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(record.points.size())),
                           problem_.bodies[at(pair.a())].change, problem_.bodies[at(pair.b())].change, forces,
                           response);
    return response;
  }

  /// The part of a force on functions that a block has not had before.
  [[nodiscard]] Eigen::VectorXd new_part(int block, const Eigen::VectorXd& force) const {
    const BlockModel& high = higher_.blocks()[at(block)];
    if (high.order() == present_.blocks()[at(block)].order() || high.rigid())
      return Eigen::VectorXd::Zero(force.size());
    return part_on_new_functions(present_.blocks()[at(block)], high, high.space().expand(force));
  }

  [[nodiscard]] bool solve(const Island& island) {
    const SimulationSettings& settings = higher_.system().settings();
    IslandSolvers solvers(LinearMethod::cholesky);
    IslandSolvers::Entry& solver =
        solver_of(island, problem_.bodies, problem_.pairs, SystemRole::step, solvers);
    IslandProblem equations(island, problem_.bodies, problem_.pairs, problem_.scheme, settings, solver);
    equations.respond();
    std::vector<PairResponse> responses = equations.responses();
    for (std::size_t n = 0; n < island.pairs.size(); ++n)
      if (const std::size_t pair = at(island.pairs[n]); record_of_.contains(pair))
        responses[n] = recorded(pair);
    equations.set_responses(responses);
    Eigen::VectorXd force = equations.residual().force;
    for (std::size_t k = 0; k < island.bodies.size(); ++k) {
      auto of_body =
          force.segment(solver.matrix.offset(static_cast<int>(k)), equations.body(k).model->freedom());
      of_body = new_part(island.bodies[k], of_body).eval();
    }
    IslandTangent tangent(equations);
    if (tangent.factorize() != FactorStatus::success) return false;
    const Eigen::VectorXd change = tangent.solve(force, true);
    if (!change.allFinite()) return false;
    equations.apply(change, 1.0);
    for (std::size_t n = 0; n < island.pairs.size(); ++n)
      if (const auto known = record_of_.find(at(island.pairs[n])); known != record_of_.end())
        record(equations, n, responses[n], equations.changes(change), snapshot_.run.records[known->second]);
    equations.respond();
    for (std::size_t n = 0; n < island.bolts.size(); ++n)
      take_forces(equations.bolts().responses()[n].end, snapshot_.run.bolts[at(island.bolts[n]->index())]);
    return true;
  }

  /// Forces and gaps of a pair after a change.
  static void record(const IslandProblem& equations, std::size_t pair, const PairResponse& before,
                     const std::vector<Eigen::VectorXd>& changes, PairRecord& record) {
    const Eigen::Matrix3Xd motion = equations.motion(pair, changes);
    for (std::size_t k = 0; k < record.responses.size(); ++k) {
      const Eigen::Vector3d moved = motion.col(static_cast<Eigen::Index>(k));
      const PointResponse& point = before.points[k];
      record.responses[k].force -=
          point.tangent * moved + point.coupling.by.dot(moved) * point.coupling.force;
      record.gaps[k] += moved[0];
    }
  }

  const Simulation& present_;
  Simulation& higher_;
  SimulationSnapshot snapshot_;
  StepProblem problem_;
  std::map<std::size_t, std::size_t> record_of_;  ///< by pair of the problem; ties have none
};

std::vector<GoalError> errors_between(const std::vector<Goal>& before, const std::vector<Goal>& after) {
  std::vector<GoalError> errors;
  for (std::size_t n = 0; n < before.size(); ++n) {
    GoalError& error = errors.emplace_back();
    for (std::size_t k = 0; k < before[n].values.size(); ++k)
      error.change.push_back(after[n].values[k] - before[n].values[k]);
    const double length = goal_length(error.change);
    if (length > 0.0) error.relative = length / std::max(goal_length(after[n].values), before[n].least);
  }
  return errors;
}

}  // namespace

std::vector<GoalError> goal_errors(const Simulation& simulation, const GoalValues& goals) {
  if (simulation.system().any_incremental()) return {};
  const std::vector<Goal> before = goals(simulation);
  if (before.empty()) return {};
  std::vector<BlockModel> models = with_next_orders(simulation);
  if (models.empty()) return {};
  SimulationSnapshot present = simulation.snapshot();
  // No contact is detected: the points are those of its records.
  present.run.pairs.clear();
  Simulation higher = with_models(simulation, std::move(models), std::move(present));
  if (!Correction(simulation, higher).apply()) return {};
  return errors_between(before, goals(higher));
}

}  // namespace ashlar

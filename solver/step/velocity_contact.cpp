#include "solver/step/velocity_contact.hpp"

#include <algorithm>
#include <limits>

#include "geometry/index.hpp"
#include "solver/contact/contact_accounts.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/step/island_equations.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

bool is_held(const PointLaw& law, const PointResponse& point) {
  return point.state != ContactState::open && (point.force[0] > 0.0 || law.tension > 0.0);
}

/// Marks points that would pull by more than they have pushed. @return whether there are any
bool let_go_of_pulls(const Island& island, const std::vector<ContactPair>& pairs, const IslandResult& result,
                     const std::vector<PairResponse>& impulses, std::vector<std::vector<bool>>& let_go) {
  bool any = false;
  for (std::size_t n = 0; n < island.pairs.size(); ++n) {
    if (pairs[at(island.pairs[n])].tied()) continue;
    for (std::size_t k = 0; k < impulses[n].means.size(); ++k) {
      if (let_go[n][k] || result.laws[n][k].tension > 0.0) continue;
      if (result.responses[n].means[k].force[0] + impulses[n].means[k].force[0] >= 0.0) continue;
      let_go[n][k] = any = true;
    }
  }
  return any;
}

}  // namespace

bool ContactPair::pushes(const PairResponse& end, const std::vector<PointLaw>& laws) const {
  for (std::size_t k = 0; !tied() && k < points_.size(); ++k) {
    if (is_held(laws[k], end.points[k])) return true;
  }
  return false;
}

PairResponse ContactPair::stopping(const PairResponse& end, const std::vector<PointLaw>& laws,
                                   const Eigen::VectorXd& ya, const Eigen::VectorXd& yb, const Stop& stop,
                                   const std::vector<bool>& let_go) const {
  // What a force moves a row by in a step, m/N, mean of some rows: it does not depend on how axes lie.
  const auto mobility = [&](Eigen::Index first, Eigen::Index count) {
    const auto part = [&](const Eigen::MatrixXd& rows, double inertia) {
      return rows.cols() > 0 ? rows.middleRows(first, count).squaredNorm() / inertia : 0.0;
    };
    return (part(rows_a_, stop.inertia_a) + part(rows_b_, stop.inertia_b)) / static_cast<double>(count);
  };
  const double of_tie = tied() ? mobility(0, 3 * static_cast<Eigen::Index>(points_.size())) : 0.0;
  const Eigen::Matrix3Xd way = relative(ya, yb) - start_;
  PairResponse result;
  result.points = end.points;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(way.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const PointResponse& point = end.points[k];
    MeanResponse mean{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector2d::Zero(), 0.0};
    const auto stiffness = [&](double mobile) {
      if (mobile <= 0.0) return 0.0;
      const bool whole = tied() || laws[k].tension > 0.0;
      const double share = whole ? 1.0 : point.force[0] / (point.force[0] + stop.allowed_way / mobile);
      return share * stop.stiffness / mobile;
    };
    if (tied()) {
      mean.tangent.diagonal().setConstant(stiffness(of_tie));
    } else if (let_go[k]) {
      mean.force = -end.means[k].force;
    } else if (is_held(laws[k], point)) {
      mean.tangent(0, 0) = stiffness(mobility(3 * column, 1));
      if (point.state == ContactState::locked)
        mean.tangent.bottomRightCorner<2, 2>().diagonal().setConstant(stiffness(mobility(3 * column + 1, 2)));
    }
    mean.force -= mean.tangent * way.col(column);
    forces.segment<3>(3 * column) = mean.force;
    result.means.push_back(mean);
  }
  set_block_forces(forces, result);
  return result;
}

void ContactPair::rub_impulses(double step) {
  for (std::size_t k = 0; k < laws_.size(); ++k)
    laws_[k].impulse_force = multiplier_scale(points_[k]) * memory_[k].unrubbed / step;
}

void ContactPair::remember_impulses(const PairResponse& response, const std::vector<PointLaw>& laws,
                                    const std::vector<Eigen::Vector3d>& impulses, double step,
                                    std::vector<PointMemory>& memory) const {
  for (std::size_t k = 0; k < impulses.size(); ++k) {
    const Eigen::Vector3d& force = response.points[k].force;
    if (response.points[k].state == ContactState::open || laws[k].friction == 0.0) continue;
    const double rubbed = std::max(0.0, force.tail<2>().norm() - laws[k].cohesion) / laws[k].friction;
    const double due = force[0] + laws[k].impulse_force + impulses[k][0];
    const double most = response.points[k].state == ContactState::sliding
                            ? std::numeric_limits<double>::infinity()
                            : std::max(impulses[k][0], 0.0);
    const double left = std::min(most, due - rubbed);
    memory[k].unrubbed = step * left / multiplier_scale(points_[k]);
  }
}

bool is_free(const BlockSystem& system, const Island& island, const std::vector<ContactPair>& pairs) {
  const auto in_free_body = [&](int block) {
    return std::any_of(system.free_bodies().begin(), system.free_bodies().end(),
                       [&](const std::vector<int>& body) {
                         return std::find(body.begin(), body.end(), block) != body.end();
                       });
  };
  return std::all_of(island.bodies.begin(), island.bodies.end(), in_free_body) &&
         std::all_of(island.pairs.begin(), island.pairs.end(), [&](int index) {
           return system.moving()[at(pairs[at(index)].a())] && system.moving()[at(pairs[at(index)].b())];
         });
}

namespace {

/// @param bodies models, and changes that are zero. @param stopped of the island's pairs is written
void stop_island(const RunContext& run, const TimeScheme& of_step, const Island& island,
                 const std::vector<ContactPair>& pairs, const IslandResult& result,
                 std::vector<BodyStep>& bodies, std::vector<StoppedPair>& stopped) {
  const double step = of_step.step;
  TimeScheme scheme;
  scheme.force_weight = 0.0;
  scheme.inertia = 1.0 / (step * step);
  IslandProblem problem(island, bodies, pairs, scheme, run.settings(),
                        solver_of(island, bodies, pairs, SystemRole::stop, run.factors.islands));
  // beta/gamma dt - dt/2, 0 but with generalized-alpha
  const double shift = 1.0 / of_step.end_velocity.change - 0.5 * step;
  std::vector<Eigen::VectorXd> start(run.blocks().size());  // u times the step
  for (const int k : island.bodies) {
    Eigen::MatrixX3d velocity = run.state.states[at(k)].velocity;
    if (!run.state.accelerations.empty()) velocity -= shift * run.state.accelerations[at(k)];
    start[at(k)] = step * run.blocks()[at(k)].space().restrict(velocity);
  }
  std::vector<Eigen::VectorXd> velocities = start;
  std::vector<std::vector<bool>> let_go;
  for (const int index : island.pairs) let_go.emplace_back(pairs[at(index)].points().size(), false);
  const auto impulses = [&] {
    const auto inertia = [&](int block) {
      return run.blocks()[at(block)].material().density * scheme.inertia;
    };
    std::vector<PairResponse> responses;
    for (std::size_t n = 0; n < island.pairs.size(); ++n) {
      const ContactPair& pair = pairs[at(island.pairs[n])];
      responses.push_back(pair.stopping(
          result.responses[n], result.laws[n], velocities[at(pair.a())], velocities[at(pair.b())],
          {run.settings().multipliers.stop_stiffness, inertia(pair.a()), inertia(pair.b()),
           run.settings().multipliers.share * run.settings().multipliers.penetration_tolerance},
          let_go[n]));
    }
    return responses;
  };
  std::vector<PairResponse> found;
  do {
    velocities = start;
    for (const int k : island.bodies) bodies[at(k)].change.setZero();
    problem.set_responses(impulses());
    if (problem.factorize() != FactorStatus::success) return;
    problem.apply(problem.solve(problem.contact_forces(), false), 1.0);
    for (const int k : island.bodies) velocities[at(k)] += bodies[at(k)].change;
    found = impulses();
  } while (let_go_of_pulls(island, pairs, result, found, let_go));

  const Vector3 momentum = angular_momentum_of(run.blocks(), island.bodies, run.state.states);
  double lost = 0.0;
  for (const int k : island.bodies) {
    const BlockModel& block = run.blocks()[at(k)];
    BlockState& state = run.state.states[at(k)];
    lost += block.kinetic_energy(state);
    state.velocity += block.space().expand(bodies[at(k)].change) / step;
    lost -= block.kinetic_energy(state);
  }
  for (const int k : island.bodies)
    velocities[at(k)] = step * run.blocks()[at(k)].space().restrict(run.state.states[at(k)].velocity) -
                        0.5 * bodies[at(k)].change;
  for (std::size_t n = 0; n < island.pairs.size(); ++n) {
    const ContactPair& pair = pairs[at(island.pairs[n])];
    StoppedPair& result_of_pair = stopped[at(island.pairs[n])];
    for (const MeanResponse& mean : found[n].means) result_of_pair.forces.push_back(mean.force);
    result_of_pair.work = pair.work(found[n], velocities[at(pair.a())], velocities[at(pair.b())]);
    // Supports that move are pushed against.
    run.state.ledger.loads_did(-pair.prescribed_work(found[n]));
    lost -= pair.prescribed_work(found[n]);
  }
  if (is_free(run.system, island, pairs)) {
    // Opposite impulses act at places that are apart by the gap.
    const Vector3 missing = momentum - angular_momentum_of(run.blocks(), island.bodies, run.state.states);
    const double own = std::max(0.0, lost);
    IslandFunds funds(run.state.pairs, {contacts_of(island, pairs)});
    const double gain =
        add_spin(run.blocks(), island.bodies, missing, own + funds.available(0), run.state.states);
    funds.use(0, std::max(0.0, gain - own));
    funds.spend_from(run.state.pairs);
    lost -= gain;
  }
  run.state.ledger.integrator_took(lost);
}

}  // namespace

std::vector<StoppedPair> stop_at_contacts(const RunContext& run, const TimeScheme& scheme,
                                          const StepProblem& problem) {
  const Stopwatch watch(run.state.log.seconds.solve);
  std::vector<StoppedPair> stopped(problem.pairs.size());
  if (!run.settings().augmented || scheme.from_rest) return stopped;
  std::vector<BodyStep> bodies(run.blocks().size());
  for (std::size_t k = 0; k < run.blocks().size(); ++k) {
    bodies[k].model = &run.blocks()[k];
    bodies[k].change = Eigen::VectorXd::Zero(run.blocks()[k].unknowns());
  }
  for (std::size_t n = 0; n < problem.islands.size(); ++n) {
    const Island& island = problem.islands[n];
    const IslandResult& result = problem.results[n];
    bool pushes = false;
    for (std::size_t k = 0; k < island.pairs.size() && !pushes; ++k)
      pushes = problem.pairs[at(island.pairs[k])].pushes(result.responses[k], result.laws[k]);
    if (pushes) stop_island(run, scheme, island, problem.pairs, result, bodies, stopped);
  }
  return stopped;
}

}  // namespace ashlar

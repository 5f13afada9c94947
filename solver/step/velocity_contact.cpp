// Where contact is augmented, a step ends with impulses that stop what pushes.
//
// A step that holds a point where it is, D = 0, ends with v' = -v, or nearly (time_scheme.hpp): the velocity
// turns round in each further step, and the contact force alternates by 2 m v/dt. Springs damp that as far as
// they give way (fastest at k dt^2/2m = 8), multipliers, whose springs are as stiff as it takes, do not. So
// contact is enforced for velocities too, by impulses of their own (Bruels, Acary and Cardona, Computer
// Methods in Applied Mechanics and Engineering 281, 2014):
//
//   M (v'' - v') = dt G^T j,   j = -c G u,   u = v'' - (beta/gamma - 1/2) dt a'
//   c = stop_stiffness m/dt N/(N + N0)        m: inertia that a point feels, N: its normal force
//
// u is what stands still under a constant force that pushes: generalized-alpha keeps a velocity there, and
// would lack the force that a steady impulse bears, and its friction. The others have u = v''.
//
// G: normal velocities of points that push, shear velocities too of those that are locked, and all of bonds
// and ties. N0 moves a point in a step by what springs may give way by: what has less force counts for
// little, so that rounding does not say what is stopped. Impulses may pull, as velocities that have turned
// round point away, but by no more than a point has pushed in the step: where more would be needed the point
// is let go, with no force at all in this step. Friction has no part in them; the bounds of shear forces in
// the next steps make up for that, up or down, as long as the point stays in contact. They take energy of
// u, never less than nothing: impacts are plastic where blocks meet, and what can deform bounces by its
// elasticity. What v loses is booked as numerical dissipation. A set of free blocks keeps its angular
// momentum: the spin for that comes from what impulses and contacts have taken (contact_accounts.hpp).
#include <algorithm>
#include <limits>

#include "geometry/index.hpp"
#include "solver/run/simulation.hpp"
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

/// Takes rows of pairs that were followed to the end of the step.
void act_at_end(const Island& island, const std::vector<ContactPair>& pairs, const IslandResult& result,
                const std::vector<BodyStep>& bodies, IslandProblem& problem) {
  const auto placed = [&](int block) -> BlockInStep {
    const BodyStep& body = bodies[at(block)];
    return {body.model, body.state->position, body.state->position, body.prescribed};
  };
  for (const auto& followed : result.followed) {
    const int index = followed.first;
    const auto place = std::find(island.pairs.begin(), island.pairs.end(), index);
    const ContactPair& pair = pairs[at(index)];
    problem.replace(static_cast<std::size_t>(place - island.pairs.begin()),
                    pair.at_end(placed(pair.a()), placed(pair.b())));
  }
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
  const Eigen::Matrix3Xd way = motion(ya, yb);
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

std::vector<Simulation::StoppedPair> Simulation::stop_at_contacts(const TimeScheme& scheme,
                                                                  const Trial& trial) {
  const Stopwatch watch(seconds_.solve);
  std::vector<StoppedPair> stopped(trial.pairs.size());
  if (!settings_.augmented || scheme.from_rest) return stopped;
  std::vector<BodyStep> bodies(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    bodies[k].model = &blocks_[k];
    bodies[k].state = &states_[k];
    bodies[k].change = Eigen::VectorXd::Zero(blocks_[k].unknowns());
    bodies[k].prescribed = trial.bodies[k].prescribed;
  }
  for (std::size_t n = 0; n < trial.islands.size(); ++n) {
    const Island& island = trial.islands[n];
    const IslandResult& result = trial.results[n];
    bool pushes = false;
    for (std::size_t k = 0; k < island.pairs.size() && !pushes; ++k)
      pushes = trial.pairs[at(island.pairs[k])].pushes(result.responses[k], result.laws[k]);
    if (pushes) stop_island(scheme, island, trial.pairs, result, bodies, stopped);
  }
  return stopped;
}

void Simulation::stop_island(const TimeScheme& of_step, const Island& island,
                             const std::vector<ContactPair>& pairs, const IslandResult& result,
                             std::vector<BodyStep>& bodies, std::vector<StoppedPair>& stopped) {
  const double step = of_step.step;
  TimeScheme scheme;
  scheme.force_weight = 0.0;
  scheme.inertia = 1.0 / (step * step);
  IslandProblem problem(island, bodies, pairs, scheme, settings_,
                        solver_of(island, bodies, pairs, SystemRole::stop, solvers_));
  act_at_end(island, pairs, result, bodies, problem);
  // beta/gamma dt - dt/2, 0 but with generalized-alpha
  const double shift = 1.0 / of_step.end_velocity.change - 0.5 * step;
  std::vector<Eigen::VectorXd> start(blocks_.size());  // u times the step
  for (const int k : island.bodies) {
    Eigen::MatrixX3d velocity = states_[at(k)].velocity;
    if (!accelerations_.empty()) velocity -= shift * accelerations_[at(k)];
    start[at(k)] = step * blocks_[at(k)].space().restrict(velocity);
  }
  std::vector<Eigen::VectorXd> velocities = start;
  std::vector<std::vector<bool>> let_go;
  for (const int index : island.pairs) let_go.emplace_back(pairs[at(index)].points().size(), false);
  const auto impulses = [&] {
    const auto inertia = [&](int block) { return blocks_[at(block)].material().density * scheme.inertia; };
    std::vector<PairResponse> responses;
    for (std::size_t n = 0; n < island.pairs.size(); ++n) {
      const ContactPair& pair = problem.pair(n);
      responses.push_back(pair.stopping(result.responses[n], result.laws[n], velocities[at(pair.a())],
                                        velocities[at(pair.b())],
                                        {settings_.stop_stiffness, inertia(pair.a()), inertia(pair.b()),
                                         settings_.multiplier_share * settings_.penetration_tolerance},
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

  const Vector3 momentum = angular_momentum_of(blocks_, island.bodies, states_);
  double lost = 0.0;
  for (const int k : island.bodies) {
    const BlockModel& block = blocks_[at(k)];
    BlockState& state = states_[at(k)];
    lost += block.kinetic_energy(state);
    state.velocity += block.space().expand(bodies[at(k)].change) / step;
    lost -= block.kinetic_energy(state);
  }
  for (const int k : island.bodies)
    velocities[at(k)] =
        step * blocks_[at(k)].space().restrict(states_[at(k)].velocity) - 0.5 * bodies[at(k)].change;
  for (std::size_t n = 0; n < island.pairs.size(); ++n) {
    const ContactPair& pair = problem.pair(n);
    StoppedPair& result_of_pair = stopped[at(island.pairs[n])];
    const std::vector<ContactPoint>& points = pairs[at(island.pairs[n])].points();
    for (std::size_t k = 0; k < points.size(); ++k)
      result_of_pair.forces.push_back(
          in_frame(points[k], out_of_frame(pair.points()[k], found[n].means[k].force)));
    result_of_pair.work = pair.work(found[n], velocities[at(pair.a())], velocities[at(pair.b())]);
    // Supports that move are pushed against.
    ledger_.applied -= pair.prescribed_work(found[n]);
    lost -= pair.prescribed_work(found[n]);
  }
  if (is_free(island, pairs)) {
    // Opposite impulses act at places that are apart by the gap.
    const Vector3 missing = momentum - angular_momentum_of(blocks_, island.bodies, states_);
    const double own = std::max(0.0, lost);
    IslandFunds funds(taken_, {contacts_of(island, pairs)});
    const double gain = add_spin(blocks_, island.bodies, missing, own + funds.available(0), states_);
    funds.use(0, std::max(0.0, gain - own));
    funds.spend_from(taken_);
    lost -= gain;
  }
  ledger_.numerical += lost;
}

}  // namespace ashlar

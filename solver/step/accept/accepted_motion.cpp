#include "solver/step/accept/accepted_motion.hpp"

#include <algorithm>
#include <limits>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/accept/angular_momentum.hpp"
#include "solver/step/accept/island_parts.hpp"
#include "solver/step/accept/turn_limit.hpp"
#include "solver/step/island/applied_force.hpp"

namespace ashlar {
namespace {

/// Velocity of moving supports at the end of a step, m/s.
Eigen::MatrixX3d support_velocity(const BlockModel& block, const BodyStep& body, const TimeScheme& scheme,
                                  double start) {
  if (!(scheme.step > 0.0)) return Eigen::MatrixX3d::Zero(body.prescribed.rows(), 3);
  // In statics time parametrises the loads.
  return scheme.is_static() ? Eigen::MatrixX3d(body.prescribed / scheme.step)
                            : block.prescribed_velocity(body.prescribed, start, scheme.step);
}

/// Velocity without the part that would deform the block, m/s. @param position at the same time
Eigen::MatrixX3d rigid_part(const BlockModel& block, const Eigen::MatrixX3d& position,
                            const Eigen::MatrixX3d& velocity) {
  // Momenta are components along these fields, which are kept.
  const Eigen::MatrixXd fields = rigid_fields(position);
  return block.space().expand(fields * (fields.transpose() * block.space().restrict(velocity)));
}

/// Moves one block to the end of the step and makes its entries in the ledger. The integrator's energy is the
/// difference between the work of all forces according to the equations and the gain of kinetic energy.
/// @return energy dissipated by the integrator, besides that of elasticity and contacts, J
double move_block(const BlockSystem& system, RunState& state, const StepProblem& problem, std::size_t k) {
  const TimeScheme& scheme = problem.scheme;
  const BodyStep& body = problem.bodies[k];
  const BlockModel& block = system.blocks()[k];
  BlockState& moved = state.states[k];
  const StepClock& clock = state.clock;
  LedgerKeeper& ledger = state.ledger;
  const double density = block.material().density;
  const Eigen::MatrixX3d change = block.space().expand(body.change);
  const bool driven = body.prescribed.size() > 0;
  // Velocity of the unknowns; that of moving supports is orthogonal to it.
  const Eigen::MatrixX3d velocity =
      driven ? block.space().expand(block.space().restrict(moved.velocity)) : moved.velocity;
  const bool carried = !state.accelerations.empty();
  const Eigen::MatrixX3d acceleration =
      carried ? state.accelerations[k] : Eigen::MatrixX3d::Zero(change.rows(), 3);
  const auto applied = [&](double when) { return applied_force(block, system.settings(), when); };
  const Eigen::MatrixX3d load = scheme.smooth_force(applied, clock.time(), clock.time_after(scheme.step));
  ledger.loads_did(body.motion().cwiseProduct(load).sum());
  const Eigen::MatrixX3d damped = scheme.damped_velocity(change, velocity, acceleration);
  const double damping = scheme.mass_damping * density * change.cwiseProduct(damped).sum();
  ledger.damping_took(damping);
  const Eigen::MatrixX3d internal = body.internal_force(scheme);
  ledger.damping_took(body.motion().cwiseProduct(internal - body.elastic.force).sum());
  const Eigen::VectorXd on_dashpots = body.dashpot_force(scheme);
  if (on_dashpots.size() > 0) ledger.damping_took(body.change.dot(on_dashpots));
  Eigen::MatrixX3d end_velocity = scheme.end_velocity(change, velocity, acceleration);
  if (block.rigid()) end_velocity = rigid_part(block, moved.position + body.motion(), end_velocity);
  const double kinetic_gain = 0.5 * density * (end_velocity.squaredNorm() - velocity.squaredNorm());
  if (driven) {
    const Eigen::MatrixX3d rate = support_velocity(block, body, scheme, clock.time());
    // Supports act against inertia and all forces but those of contacts, which are booked by pair.
    const Eigen::MatrixX3d external = external_force(system, clock, static_cast<int>(k), scheme);
    ledger.loads_did(0.5 * density * (rate.squaredNorm() - (moved.velocity - velocity).squaredNorm()) +
                     body.prescribed.cwiseProduct(internal - external).sum());
    moved.velocity = end_velocity + rate;
  } else {
    moved.velocity = end_velocity;
  }
  moved.position += body.motion();
  // Prevents rounding errors from accumulating as strain.
  if (block.rigid()) moved.position = block.rigid_position(moved.position);
  Eigen::VectorXd smooth = body.external_force - block.space().restrict(internal);
  if (on_dashpots.size() > 0) smooth -= on_dashpots;
  const double work = density * scheme.inertia * body.change.dot(body.change - body.free_change) +
                      (1.0 - scheme.force_weight) * body.change.dot(smooth) - damping;
  const double dissipated = work - kinetic_gain;
  ledger.integrator_took(dissipated);
  if (!carried) return dissipated;
  state.accelerations[k] = scheme.end_acceleration<Eigen::MatrixX3d>(
      block.space().expand(smooth) / density - scheme.mass_damping * damped, acceleration);
  return dissipated;
}

/// Energies of blocks in a step.
struct BlockEnergies {
  std::vector<double> dissipated;  ///< by the integrator in each block, elasticity included, J
  PotentialSum potential;          ///< elastic
};

BlockEnergies move_all(const BlockSystem& system, RunState& state, const StepProblem& problem) {
  LedgerKeeper& ledger = state.ledger;
  BlockEnergies energies{std::vector<double>(system.blocks().size(), 0.0), {}};
  for (int k = 0; k < system.count(); ++k) {
    if (!system.moving()[at(k)] || !system.owns(k)) continue;
    const BodyStep& body = problem.bodies[at(k)];
    const double work = -body.motion().cwiseProduct(body.elastic.force).sum();
    const double last_energy = ledger.elastic_energy(k);
    double dissipated = move_block(system, state, problem, at(k));
    ledger.measure_elastic(system, state.states, k);
    const double change = ledger.elastic_energy(k) - last_energy;
    dissipated -= work + change;
    energies.dissipated[at(k)] = dissipated;
    energies.potential.work += work;
    energies.potential.change += change;
  }
  return energies;
}

/// Loads and forces of contacts, ties and bolts on the unknowns of all blocks.
std::vector<Eigen::VectorXd> forces_on_blocks(const BlockSystem& system, const StepProblem& problem) {
  const std::vector<BlockModel>& blocks = system.blocks();
  std::vector<Eigen::VectorXd> forces(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) forces[k] = problem.bodies[k].external_force;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    for (std::size_t n = 0; n < problem.islands[i].pairs.size(); ++n) {
      const ContactPair& pair = problem.pairs[at(problem.islands[i].pairs[n])];
      const PairResponse& response = problem.results[i].responses[n];
      if (system.moving()[at(pair.a())]) forces[at(pair.a())] += response.total_on_a();
      if (system.moving()[at(pair.b())]) forces[at(pair.b())] += response.total_on_b();
    }
    for (std::size_t n = 0; n < problem.islands[i].bolts.size(); ++n) {
      const std::vector<int>& held = problem.islands[i].bolts[n]->blocks();
      for (std::size_t k = 0; k < held.size(); ++k)
        if (system.moving()[at(held[k])])
          forces[at(held[k])] += problem.results[i].bolts[n].response.on_blocks[k];
    }
  }
  return forces;
}

/// Free bodies that have rotated in a step, and what it has done to them.
class TurnedBodies {
 public:
  /// @param before states at the start of the step. @param dissipated by the integrator in each block, J
  TurnedBodies(const BlockSystem& system, RunState& state, const StepProblem& problem,
               const std::vector<BlockState>& before, const std::vector<double>& dissipated)
      : system_(system),
        state_(state),
        scheme_(problem.scheme),
        before_(before),
        dissipated_(dissipated),
        forces_(forces_on_blocks(system, problem)) {}

  /// Returns the spin of a body all of whose blocks are here.
  void return_spin(const std::vector<int>& body) {
    const Loss loss = loss_of(body, centroid_of(system_.blocks(), body, before_));
    const double gain =
        add_spin(system_.blocks(), body, -loss.stray, std::max(loss.limit, 0.0), state_.states);
    note_gain(body.front(), loss.limit, gain);
  }

  /// The same of bodies with blocks of several processes. Collective. @param bodies the same on all processes
  void return_spins(const std::vector<std::vector<int>>& bodies) {
    std::vector<std::vector<int>> own;
    Eigen::MatrixXd masses = Eigen::MatrixXd::Zero(4, static_cast<Eigen::Index>(bodies.size()));
    for (const std::vector<int>& body : bodies) {
      std::vector<int>& here = own.emplace_back();
      const auto column = static_cast<Eigen::Index>(own.size()) - 1;
      for (const int k : body) {
        if (!system_.owns(k) || !system_.moving()[at(k)]) continue;
        here.push_back(k);
        masses(0, column) += system_.blocks()[at(k)].mass();
      }
      if (!here.empty())
        masses.col(column).tail<3>() = masses(0, column) * centroid_of(system_.blocks(), here, before_);
    }
    sum_of_run(system_, masses);
    Eigen::MatrixXd losses = Eigen::MatrixXd::Zero(4, masses.cols());  // momentum, limit
    for (std::size_t n = 0; n < own.size(); ++n) {
      const auto column = static_cast<Eigen::Index>(n);
      if (own[n].empty()) continue;
      const Loss loss = loss_of(own[n], masses.col(column).tail<3>() / masses(0, column));
      losses.col(column) << loss.stray, loss.limit;
    }
    sum_of_run(system_, losses);
    std::vector<std::vector<int>> turned;
    std::vector<Eigen::Index> columns;
    std::vector<Vector3> missing;
    for (std::size_t n = 0; n < own.size(); ++n) {
      const auto column = static_cast<Eigen::Index>(n);
      if (!(masses(0, column) > 0.0)) continue;  // asleep
      turned.push_back(own[n]);
      columns.push_back(column);
      missing.emplace_back(-losses.col(column).head<3>());
    }
    const std::vector<Spin> spins =
        spins_of(system_.blocks(), turned, missing, state_.states, summed_over_processes(system_));
    for (std::size_t n = 0; n < turned.size(); ++n) {
      const double limit = losses(3, columns[n]);
      const double share = spins[n].share_within(std::max(limit, 0.0));
      spins[n].add(share, system_.blocks(), turned[n], state_.states);
      const int first = bodies[static_cast<std::size_t>(columns[n])].front();
      if (system_.owns(first)) note_gain(first, limit, spins[n].gain(share));
    }
  }

 private:
  struct Loss {
    Vector3 stray = Vector3::Zero();  ///< kg m^2/s, gained without force
    double limit = 0.0;               ///< of the energy of the spin, J
  };

  Loss loss_of(const std::vector<int>& body, const Vector3& origin) {
    Loss loss;
    for (const int k : body) {
      loss.limit += dissipated_[at(k)] + state_.spin_debts[at(k)];
      state_.spin_debts[at(k)] = 0.0;
      const BlockModel& block = system_.blocks()[at(k)];
      const BlockState& start = before_[at(k)];
      const BlockState& end = state_.states[at(k)];
      const Eigen::MatrixX3d damped =
          scheme_.end_share * end.velocity + (1.0 - scheme_.end_share) * start.velocity;
      const Eigen::MatrixX3d known =
          block.space().expand(forces_[at(k)]) - scheme_.mass_damping * block.material().density * damped;
      loss.stray += stray_angular_momentum(block, start, end, known, scheme_.step, origin);
    }
    // generalized-alpha returns energy that it took before.
    if (!state_.accelerations.empty()) loss.limit = std::numeric_limits<double>::infinity();
    return loss;
  }

  void note_gain(int first, double limit, double gain) {
    state_.ledger.integrator_took(-gain);
    state_.spin_debts[at(first)] = std::min(0.0, limit - gain);
  }

  const BlockSystem& system_;
  RunState& state_;
  const TimeScheme& scheme_;
  const std::vector<BlockState>& before_;
  const std::vector<double>& dissipated_;
  std::vector<Eigen::VectorXd> forces_;
};

/// Returns to free blocks the spin that a step has removed, see angular_momentum.hpp. With several processes collective.
/// @param before states at the start of the step. @param dissipated by the integrator in each block, J
void keep_angular_momentum(const BlockSystem& system, RunState& state, const StepProblem& problem,
                           const std::vector<BlockState>& before, const std::vector<double>& dissipated) {
  TurnedBodies bodies(system, state, problem, before, dissipated);
  const auto is_own = [&system](int block) { return system.owns(block); };
  for (const std::vector<int>& body : system.free_bodies())
    if (system.moving()[at(body.front())] && std::all_of(body.begin(), body.end(), is_own))
      bodies.return_spin(body);
  if (!system.parted_bodies().empty()) bodies.return_spins(system.parted_bodies());
}

/// Notes how far blocks turn in a step. @param before states at its start
void note_turns(const BlockSystem& system, RunState& state, const std::vector<BlockState>& before,
                double step) {
  LargestTurn& largest = state.extremes.turn;
  for (int k = 0; k < system.count(); ++k) {
    if (!system.moving()[at(k)] || !system.owns(k)) continue;
    const double angle = turn_between(before[at(k)].position, state.states[at(k)].position);
    if (angle > largest.angle) largest = {k, angle, state.clock.time_after(step), largest.limited};
  }
}

}  // namespace

PotentialSum move_blocks(const BlockSystem& system, RunState& state, const StepProblem& problem) {
  const TimeScheme& scheme = problem.scheme;
  const bool any_free = !system.free_bodies().empty() || !system.parted_bodies().empty();
  const bool gives_spin_back = !scheme.mean_contacts && !scheme.is_static() && any_free;
  std::vector<BlockState> before;
  if (!scheme.is_static()) before = state.states;
  const BlockEnergies energies = move_all(system, state, problem);
  if (gives_spin_back) keep_angular_momentum(system, state, problem, before, energies.dissipated);
  if (!scheme.is_static()) note_turns(system, state, before, scheme.step);
  return energies.potential;
}

}  // namespace ashlar

#include "solver/step/accepted_motion.hpp"

#include <algorithm>
#include <limits>

#include "geometry/index.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/step/applied_force.hpp"

namespace ashlar {
namespace {

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
  if (block.rigid()) {
    // Momenta are components along these fields, which are kept.
    const Eigen::MatrixXd fields = rigid_fields(moved.position + body.motion());
    end_velocity = block.space().expand(fields * (fields.transpose() * block.space().restrict(end_velocity)));
  }
  const double kinetic_gain = 0.5 * density * (end_velocity.squaredNorm() - velocity.squaredNorm());
  if (driven) {
    Eigen::MatrixX3d rate = Eigen::MatrixX3d::Zero(change.rows(), 3);
    // In statics time parametrises the loads.
    if (scheme.step > 0.0)
      rate = scheme.is_static() ? Eigen::MatrixX3d(body.prescribed / scheme.step)
                                : block.prescribed_velocity(body.prescribed, clock.time(), scheme.step);
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

/// Returns to free blocks the spin that a step has removed, see angular_momentum.hpp.
/// @param before states at the start of the step. @param dissipated by the integrator in each block, J
void keep_angular_momentum(const BlockSystem& system, RunState& state, const StepProblem& problem,
                           const std::vector<BlockState>& before, const std::vector<double>& dissipated) {
  const TimeScheme& scheme = problem.scheme;
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
  std::vector<double>& debts = state.spin_debts;
  for (const std::vector<int>& body : system.free_bodies()) {
    if (!system.moving()[at(body.front())]) continue;
    Vector3 stray = Vector3::Zero();
    double limit = 0.0;
    const Vector3 origin = centroid_of(blocks, body, before);
    for (const int k : body) {
      limit += dissipated[at(k)] + debts[at(k)];
      debts[at(k)] = 0.0;
      const BlockModel& block = blocks[at(k)];
      const BlockState& start = before[at(k)];
      const BlockState& end = state.states[at(k)];
      const Eigen::MatrixX3d damped =
          scheme.end_share * end.velocity + (1.0 - scheme.end_share) * start.velocity;
      const Eigen::MatrixX3d known =
          block.space().expand(forces[at(k)]) - scheme.mass_damping * block.material().density * damped;
      stray += stray_angular_momentum(block, start, end, known, scheme.step, origin);
    }
    // generalized-alpha returns energy that it took before.
    if (!state.accelerations.empty()) limit = std::numeric_limits<double>::infinity();
    const double gain = add_spin(blocks, body, -stray, std::max(limit, 0.0), state.states);
    state.ledger.integrator_took(-gain);
    debts[at(body.front())] = std::min(0.0, limit - gain);
  }
}

}  // namespace

PotentialSum move_blocks(const BlockSystem& system, RunState& state, const StepProblem& problem) {
  const TimeScheme& scheme = problem.scheme;
  const bool gives_spin_back = !scheme.mean_contacts && !scheme.is_static() && !system.free_bodies().empty();
  std::vector<BlockState> before;
  if (gives_spin_back) before = state.states;
  const BlockEnergies energies = move_all(system, state, problem);
  if (gives_spin_back) keep_angular_momentum(system, state, problem, before, energies.dissipated);
  return energies.potential;
}

}  // namespace ashlar

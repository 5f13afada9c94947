// What a simulation takes over from a step that was accepted: motion, ledger, memory of contacts.
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/index.hpp"
#include "solver/run/simulation.hpp"
#include "solver/step/angular_momentum.hpp"

namespace ashlar {

/// What the equations say about the work of all forces and what the kinetic energy gained differ by what the
/// integrator takes.
double Simulation::move_block(std::size_t k, const TimeScheme& scheme, const BodyStep& body) {
  const BlockModel& block = blocks_[k];
  BlockState& state = states_[k];
  const double density = block.material().density;
  const Eigen::MatrixX3d change = block.space().expand(body.change);
  const bool driven = body.prescribed.size() > 0;
  // The velocity of the unknowns; that of supports that move is orthogonal to it.
  const Eigen::MatrixX3d velocity =
      driven ? block.space().expand(block.space().restrict(state.velocity)) : state.velocity;
  const bool carried = !accelerations_.empty();
  const Eigen::MatrixX3d acceleration =
      carried ? accelerations_[k] : Eigen::MatrixX3d::Zero(change.rows(), 3);
  Eigen::MatrixX3d load = block.load_force(clock_.time_after(scheme.step));
  if (scheme.end_share < 1.0)
    load = scheme.end_share * load + (1.0 - scheme.end_share) * block.load_force(time());
  ledger_.applied += body.motion().cwiseProduct(load).sum();
  const Eigen::MatrixX3d damped = scheme.damped_velocity(change, velocity, acceleration);
  const double damping = scheme.mass_damping * density * change.cwiseProduct(damped).sum();
  ledger_.damping += damping;
  const Eigen::MatrixX3d end_velocity = scheme.end_velocity(change, velocity, acceleration);
  const double kinetic_gain = 0.5 * density * (end_velocity.squaredNorm() - velocity.squaredNorm());
  if (driven) {
    Eigen::MatrixX3d rate = Eigen::MatrixX3d::Zero(change.rows(), 3);
    // In statics time stands for loads.
    if (scheme.step > 0.0)
      rate = scheme.from_rest ? Eigen::MatrixX3d(body.prescribed / scheme.step)
                              : block.prescribed_velocity(body.prescribed, time(), scheme.step);
    // Supports push against inertia and all forces but those of contacts, which accept() knows.
    ledger_.applied += 0.5 * density * (rate.squaredNorm() - (state.velocity - velocity).squaredNorm()) +
                       body.prescribed.cwiseProduct(body.elastic.force - external_force(block, scheme)).sum();
    state.velocity = end_velocity + rate;
  } else {
    state.velocity = end_velocity;
  }
  state.position += body.motion();
  const Eigen::VectorXd smooth = body.external_force - block.space().restrict(body.elastic.force);
  const double work = density * scheme.inertia * body.change.dot(body.change - body.free_change) +
                      (1.0 - scheme.force_weight) * body.change.dot(smooth) - damping;
  const double dissipated = work - kinetic_gain;
  ledger_.numerical += dissipated;
  if (!carried) return dissipated;
  accelerations_[k] = scheme.end_acceleration<Eigen::MatrixX3d>(
      block.space().expand(smooth) / density - scheme.mass_damping * damped, acceleration);
  return dissipated;
}

void Simulation::accept(const TimeScheme& scheme, Trial& trial) {
  const auto& [pairs, islands, bodies, results, carried, depths] = trial;
  solvers_.drop_unused();
  lone_factors_.drop_unused();
  finder_.accept_motion();
  const double last_residual = ledger_.residual;
  const bool gives_spin_back = !scheme.mean_contacts && !scheme.from_rest && !free_bodies_.empty();
  std::vector<BlockState> before;
  if (gives_spin_back) before = states_;
  double potential_work = 0.0;
  double potential_change = 0.0;
  std::vector<double> dissipated(blocks_.size(), 0.0);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k]) continue;
    const double work = -bodies[k].motion().cwiseProduct(bodies[k].elastic.force).sum();
    const double last_energy = elastic_energies_[k];
    dissipated[k] = move_block(k, scheme, bodies[k]);
    note_elastic_energy(k);
    const double change = elastic_energies_[k] - last_energy;
    dissipated[k] -= work + change;
    potential_work += work;
    potential_change += change;
  }
  if (gives_spin_back) keep_angular_momentum(scheme, trial, before, dissipated);

  const std::vector<StoppedPair> stopped = stop_at_contacts(scheme, trial);
  book_refound(pairs);
  report_ = StepReport{};
  report_.step = scheme.step;
  records_.clear();
  ledger_.contact = 0.0;
  double friction = 0.0;
  std::map<PairKey, ContactMemory> memory;
  const double tearing_gap = settings_.tearing_share * settings_.contact_distance;
  std::map<int, double> bulges;
  const auto bulge_of = [&](int block) {
    const auto [known, is_new] = bulges.emplace(block, 0.0);
    if (is_new) known->second = finder_.surfaces()[at(block)].bulge(states_[at(block)]);
    return known->second;
  };
  for (std::size_t i = 0; i < islands.size(); ++i) {
    report_.iterations = std::max(report_.iterations, results[i].iterations);
    for (std::size_t n = 0; n < islands[i].pairs.size(); ++n) {
      const ContactPair& pair = pairs[at(islands[i].pairs[n])];
      const PairResponse& after = results[i].responses[n];
      const std::vector<PointLaw>& laws = results[i].laws[n];
      const Eigen::VectorXd& ya = bodies[at(pair.a())].change;
      const Eigen::VectorXd& yb = bodies[at(pair.b())].change;
      const double work = pair.work(after, ya, yb);
      ledger_.applied -= pair.prescribed_work(after);
      potential_work += work;
      const SpringEnergy held = ContactPair::energies(after);
      potential_change += held.total() - pair.start_energy();
      ledger_.contact += held.total();
      if (pair.tied()) continue;
      const double slid = pair.friction_work(after, laws, ya, yb);
      friction += slid;
      if (settings_.augmented && !scheme.from_rest)
        take_for_multipliers(pair, -pair.spring_work(after, ya, yb) - slid);
      auto gaps = pair.gaps(ya, yb);
      double deepest = 0.0;
      for (std::size_t k = 0; k < gaps.size(); ++k) {
        const ContactState state = after.points[k].state;
        ++(state == ContactState::open     ? report_.open
           : state == ContactState::locked ? report_.locked
                                           : report_.sliding);
        // Springs may be open and at rest below the surface.
        deepest = std::max(deepest, -gaps[k]);
      }
      report_.penetration = std::max(report_.penetration, deepest);
      const double bulge = bulge_of(pair.a()) + bulge_of(pair.b());
      const StoppedPair& stop = stopped[at(islands[i].pairs[n])];
      std::vector<PointMemory> remembered = pair.memory_after(after, laws, ya, yb, tearing_gap);
      pair.remember_impulses(after, laws, stop.forces, scheme.step, remembered);
      memory[{pair.a(), pair.b()}].store(pair.points(), std::move(remembered), deepest, held, bulge,
                                         pair.cuts());
      // Forces that acted: with average-acceleration not those at the end, with multipliers impulses too.
      std::vector<PointResponse> acted = after.points;
      for (std::size_t k = 0; k < acted.size(); ++k) {
        acted[k].force = after.means[k].force;
        if (!stop.forces.empty()) acted[k].force += stop.forces[k];
      }
      if (settings_.augmented && !scheme.from_rest) tally_friction(acted, laws, scheme.step);
      records_.push_back({pair.a(), pair.b(), pair.points(), std::move(acted), std::move(gaps),
                          contact_work_[{pair.a(), pair.b()}] += work + stop.work});
    }
  }
  memory_ = std::move(memory);
  ledger_.friction += friction;
  ledger_.numerical -= potential_work + potential_change + friction;

  for (auto& [block, next] : trial.carried) start_carried_step(block, std::move(next));
  clock_.advance(scheme.step);
  ++steps_;
  measure_energies(ledger_);
  ledger_.residual = ledger_.balance() - start_balance_;
  largest_step_residual_ = std::max(largest_step_residual_, std::abs(ledger_.residual - last_residual));
  largest_energy_ = std::max({largest_energy_, ledger_.kinetic, ledger_.elastic, ledger_.contact,
                              std::abs(ledger_.friction), std::abs(ledger_.applied)});
  largest_penetration_ = std::max(largest_penetration_, report_.penetration);
  note_depths(depths);
}

void Simulation::keep_angular_momentum(const TimeScheme& scheme, const Trial& trial,
                                       const std::vector<BlockState>& before,
                                       const std::vector<double>& dissipated) {
  std::vector<Eigen::VectorXd> forces(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) forces[k] = trial.bodies[k].external_force;
  for (std::size_t i = 0; i < trial.islands.size(); ++i) {
    for (std::size_t n = 0; n < trial.islands[i].pairs.size(); ++n) {
      const ContactPair& pair = trial.pairs[at(trial.islands[i].pairs[n])];
      const PairResponse& response = trial.results[i].responses[n];
      if (moving_[at(pair.a())]) forces[at(pair.a())] += response.total_on_a();
      if (moving_[at(pair.b())]) forces[at(pair.b())] += response.total_on_b();
    }
  }
  for (const std::vector<int>& body : free_bodies_) {
    Vector3 stray = Vector3::Zero();
    double limit = 0.0;
    const Vector3 origin = centroid_of(blocks_, body, before);
    for (const int k : body) {
      limit += dissipated[at(k)] + spin_debts_[at(k)];
      spin_debts_[at(k)] = 0.0;
      const BlockModel& block = blocks_[at(k)];
      const BlockState& start = before[at(k)];
      const BlockState& end = states_[at(k)];
      const Eigen::MatrixX3d damped =
          scheme.end_share * end.velocity + (1.0 - scheme.end_share) * start.velocity;
      const Eigen::MatrixX3d known =
          block.space().expand(forces[at(k)]) - scheme.mass_damping * block.material().density * damped;
      stray += stray_angular_momentum(block, start, end, known, scheme.step, origin);
    }
    // generalized-alpha gives energy back that it took before.
    if (!accelerations_.empty()) limit = std::numeric_limits<double>::infinity();
    const double gain = add_spin(blocks_, body, -stray, std::max(limit, 0.0), states_);
    ledger_.numerical -= gain;
    spin_debts_[at(body.front())] = std::min(0.0, limit - gain);
  }
}

void Simulation::tally_friction(const std::vector<PointResponse>& acted, const std::vector<PointLaw>& laws,
                                double step) {
  for (std::size_t k = 0; k < acted.size(); ++k) {
    if (acted[k].state != ContactState::sliding) continue;
    const Eigen::Vector3d& force = acted[k].force;
    sliding_friction_.due += step * (laws[k].cohesion + laws[k].friction * std::max(force[0], 0.0));
    sliding_friction_.acted += step * force.tail<2>().norm();
  }
}

void Simulation::take_for_multipliers(const ContactPair& pair, double work) {
  const double beyond = book(work, taken_[{pair.a(), pair.b()}]);
  ledger_.refound_gained += beyond;
  ledger_.numerical += beyond;
}

void Simulation::note_elastic_energy(std::size_t k) {
  if (moving_[k]) elastic_energies_[k] = blocks_[k].elastic(states_[k].position).energy;
}

void Simulation::note_elastic_energies() {
  elastic_energies_.assign(blocks_.size(), 0.0);
  for (std::size_t k = 0; k < blocks_.size(); ++k) note_elastic_energy(k);
}

void Simulation::book_refound(const std::vector<ContactPair>& pairs) {
  // Springs of one pair may take over what those of another one held.
  double change = 0.0;
  for (const ContactPair& pair : pairs)
    change += pair.tied() ? 0.0 : pair.start_energy();  // a tie is the same in every step
  for (const PairRecord& record : records_)
    for (const PointResponse& response : record.responses) change -= response.energy();
  (change > 0.0 ? ledger_.refound_gained : ledger_.refound_lost) += std::abs(change);
}

void Simulation::measure_energies(Ledger& ledger) const {
  ledger.kinetic = ledger.elastic = ledger.gravity = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k]) continue;
    ledger.kinetic += blocks_[k].kinetic_energy(states_[k]);
    ledger.elastic += elastic_energies_[k];
    ledger.gravity += blocks_[k].gravity_energy(states_[k], settings_.gravity);
  }
}

}  // namespace ashlar

#include "solver/step/accepted_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "geometry/index.hpp"
#include "solver/contact/contact_accounts.hpp"
#include "solver/step/accepted_bolts.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/step/applied_force.hpp"
#include "solver/step/block_changes.hpp"
#include "solver/step/end_state.hpp"
#include "solver/step/sleeping_islands.hpp"
#include "solver/step/velocity_contact.hpp"

namespace ashlar {
namespace {

/// Moves one block to the end of the step and makes its entries in the ledger. The integrator's energy is the
/// difference between the work of all forces according to the equations and the gain of kinetic energy.
/// @return energy dissipated by the integrator, besides that of elasticity and contacts, J
double move_block(const RunContext& run, std::size_t k, const TimeScheme& scheme, const BodyStep& body) {
  const BlockModel& block = run.blocks()[k];
  BlockState& state = run.state.states[k];
  const StepClock& clock = run.state.clock;
  LedgerKeeper& ledger = run.state.ledger;
  const double density = block.material().density;
  const Eigen::MatrixX3d change = block.space().expand(body.change);
  const bool driven = body.prescribed.size() > 0;
  // Velocity of the unknowns; that of moving supports is orthogonal to it.
  const Eigen::MatrixX3d velocity =
      driven ? block.space().expand(block.space().restrict(state.velocity)) : state.velocity;
  const bool carried = !run.state.accelerations.empty();
  const Eigen::MatrixX3d acceleration =
      carried ? run.state.accelerations[k] : Eigen::MatrixX3d::Zero(change.rows(), 3);
  const auto applied = [&](double when) { return applied_force(block, run.settings(), when); };
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
    const Eigen::MatrixXd fields = rigid_fields(state.position + body.motion());
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
    const Eigen::MatrixX3d external = external_force(run.system, clock, static_cast<int>(k), scheme);
    ledger.loads_did(0.5 * density * (rate.squaredNorm() - (state.velocity - velocity).squaredNorm()) +
                     body.prescribed.cwiseProduct(internal - external).sum());
    state.velocity = end_velocity + rate;
  } else {
    state.velocity = end_velocity;
  }
  state.position += body.motion();
  // Prevents rounding errors from accumulating as strain.
  if (block.rigid()) state.position = block.rigid_position(state.position);
  Eigen::VectorXd smooth = body.external_force - block.space().restrict(internal);
  if (on_dashpots.size() > 0) smooth -= on_dashpots;
  const double work = density * scheme.inertia * body.change.dot(body.change - body.free_change) +
                      (1.0 - scheme.force_weight) * body.change.dot(smooth) - damping;
  const double dissipated = work - kinetic_gain;
  ledger.integrator_took(dissipated);
  if (!carried) return dissipated;
  run.state.accelerations[k] = scheme.end_acceleration<Eigen::MatrixX3d>(
      block.space().expand(smooth) / density - scheme.mass_damping * damped, acceleration);
  return dissipated;
}

/// Work on potentials and what these gained, J.
struct PotentialSum {
  double work = 0.0;
  double change = 0.0;
};

/// Moves all blocks. @return energy dissipated by the integrator in each block, elasticity included, J
std::vector<double> move_blocks(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem,
                                PotentialSum& potential) {
  LedgerKeeper& ledger = run.state.ledger;
  std::vector<double> dissipated(run.blocks().size(), 0.0);
  for (int k = 0; k < run.system.count(); ++k) {
    if (!run.system.moving()[at(k)]) continue;
    const BodyStep& body = problem.bodies[at(k)];
    const double work = -body.motion().cwiseProduct(body.elastic.force).sum();
    const double last_energy = ledger.elastic_energy(k);
    dissipated[at(k)] = move_block(run, at(k), scheme, body);
    ledger.measure_elastic(run.system, run.state.states, k);
    const double change = ledger.elastic_energy(k) - last_energy;
    dissipated[at(k)] -= work + change;
    potential.work += work;
    potential.change += change;
  }
  return dissipated;
}

/// Returns to free blocks the spin that a step has removed, see angular_momentum.hpp.
/// @param before states at the start of the step. @param dissipated by the integrator in each block, J
void keep_angular_momentum(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem,
                           const std::vector<BlockState>& before, const std::vector<double>& dissipated) {
  const std::vector<BlockModel>& blocks = run.blocks();
  std::vector<Eigen::VectorXd> forces(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) forces[k] = problem.bodies[k].external_force;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    for (std::size_t n = 0; n < problem.islands[i].pairs.size(); ++n) {
      const ContactPair& pair = problem.pairs[at(problem.islands[i].pairs[n])];
      const PairResponse& response = problem.results[i].responses[n];
      if (run.system.moving()[at(pair.a())]) forces[at(pair.a())] += response.total_on_a();
      if (run.system.moving()[at(pair.b())]) forces[at(pair.b())] += response.total_on_b();
    }
    for (std::size_t n = 0; n < problem.islands[i].bolts.size(); ++n) {
      const std::vector<int>& held = problem.islands[i].bolts[n]->blocks();
      for (std::size_t k = 0; k < held.size(); ++k)
        if (run.system.moving()[at(held[k])])
          forces[at(held[k])] += problem.results[i].bolts[n].response.on_blocks[k];
    }
  }
  std::vector<double>& debts = run.state.spin_debts;
  for (const std::vector<int>& body : run.system.free_bodies()) {
    if (!run.system.moving()[at(body.front())]) continue;
    Vector3 stray = Vector3::Zero();
    double limit = 0.0;
    const Vector3 origin = centroid_of(blocks, body, before);
    for (const int k : body) {
      limit += dissipated[at(k)] + debts[at(k)];
      debts[at(k)] = 0.0;
      const BlockModel& block = blocks[at(k)];
      const BlockState& start = before[at(k)];
      const BlockState& end = run.state.states[at(k)];
      const Eigen::MatrixX3d damped =
          scheme.end_share * end.velocity + (1.0 - scheme.end_share) * start.velocity;
      const Eigen::MatrixX3d known =
          block.space().expand(forces[at(k)]) - scheme.mass_damping * block.material().density * damped;
      stray += stray_angular_momentum(block, start, end, known, scheme.step, origin);
    }
    // generalized-alpha returns energy that it took before.
    if (!run.state.accelerations.empty()) limit = std::numeric_limits<double>::infinity();
    const double gain = add_spin(blocks, body, -stray, std::max(limit, 0.0), run.state.states);
    run.state.ledger.integrator_took(-gain);
    debts[at(body.front())] = std::min(0.0, limit - gain);
  }
}

/// True if one of two blocks moves; contacts between other blocks stay as they were.
bool is_live(const RunContext& run, int a, int b) {
  return run.system.moving()[at(a)] || run.system.moving()[at(b)];
}

/// Books the change of spring energy due to re-detected contacts since the end of the last step.
void book_redetection(const RunContext& run, const std::vector<ContactPair>& pairs) {
  // Springs of one pair may replace those of another one.
  double change = 0.0;
  std::set<PairKey> going_on;  // their springs, like ties, are the same as before
  for (const ContactPair& pair : pairs) {
    if (pair.goes_on())
      going_on.insert({pair.a(), pair.b()});
    else if (!pair.tied())
      change += pair.start_energy();
  }
  for (const PairRecord& record : run.state.records) {
    if (!is_live(run, record.a, record.b) || going_on.count({record.a, record.b}) > 0) continue;
    for (const PointResponse& response : record.responses) change -= response.energy();
  }
  run.state.ledger.found_anew(change);
}

/// Adds energy that the blocks of a pair have spent on multipliers to its account. Energy released beyond the account
/// is booked as gained. @param work J; negative: released
void take_for_multipliers(const RunContext& run, const ContactPair& pair, double work) {
  run.state.ledger.multipliers_gave(book(work, run.state.pairs[{pair.a(), pair.b()}].taken));
}

/// In statics multipliers gradually replace compressed springs. Returns the energy of springs of the pair's own
/// stiffness under the same forces, J. Motion from there may release it (augmented_contact.md).
double taken_in_statics(const ContactPair& pair, const PairResponse& response) {
  double energy = 0.0;
  for (std::size_t k = 0; k < response.points.size(); ++k) {
    const PointLaw& law = pair.laws()[k];
    if (!law.augmented) continue;
    const Eigen::Vector3d& force = response.points[k].force;
    energy += 0.5 * force[0] * force[0] / law.normal_stiffness;
    if (law.shear_stiffness > 0.0) energy += 0.5 * force.tail<2>().squaredNorm() / law.shear_stiffness;
  }
  return energy;
}

/// @param acted forces of a pair's points over a step, impulses included
void tally_friction(const std::vector<PointResponse>& acted, const std::vector<PointLaw>& laws, double step,
                    FrictionTally& tally) {
  for (std::size_t k = 0; k < acted.size(); ++k) {
    if (acted[k].state != ContactState::sliding) continue;
    const Eigen::Vector3d& force = acted[k].force;
    tally.due += step * (laws[k].cohesion + laws[k].friction * std::max(force[0], 0.0));
    tally.acted += step * force.tail<2>().norm();
  }
}

/// Adds the slip of a dilating pair in a step.
void tally_slip(const ContactPair& pair, const PairResponse& response, const Eigen::VectorXd& ya,
                const Eigen::VectorXd& yb, DilatingSlip& tally) {
  const Eigen::Matrix3Xd moved = pair.motion(ya, yb);
  double slip = 0.0;
  bool touches = false;
  bool has_dilated = false;
  for (std::size_t k = 0; k < response.points.size(); ++k) {
    slip += pair.points()[k].area * moved.col(static_cast<Eigen::Index>(k)).tail<2>().norm();
    touches = touches || response.points[k].state != ContactState::open;
    has_dilated = has_dilated || pair.dilation_before(k) > 0.0;
  }
  if (!touches && !has_dilated) return;
  tally.all += slip;
  if (!touches) tally.in_flight += slip;
}

void count_states(const std::vector<PointResponse>& points, StepReport& report) {
  for (const PointResponse& point : points) {
    ++(point.state == ContactState::open     ? report.open
       : point.state == ContactState::locked ? report.locked
                                             : report.sliding);
  }
}

/// Largest depth of a pair's points, m, >= 0. Springs may be open and unloaded there.
double deepest_of(const std::vector<double>& gaps) {
  double deepest = 0.0;
  for (const double gap : gaps) deepest = std::max(deepest, -gap);
  return deepest;
}

/// Keeps records of pairs whose blocks do not move, with their part of the report, and drops the others.
void keep_sleeping_pairs(const RunContext& run) {
  StepReport& report = run.state.report;
  for (auto& [blocks, pair] : run.state.pairs)
    if (is_live(run, blocks[0], blocks[1])) {
      pair.memory = ContactMemory();
      if (pair.cache && !pair.cache->found.points.empty()) pair.cache.reset();
    }
  std::erase_if(run.state.records,
                [&run](const PairRecord& record) { return is_live(run, record.a, record.b); });
  for (const PairRecord& record : run.state.records) {
    count_states(record.responses, report);
    report.penetration = std::max(report.penetration, deepest_of(record.gaps));
  }
}

/// One pair of a step that was accepted.
struct AcceptedPair {
  const ContactPair& pair;
  const PairResponse& response;
  const std::vector<PointLaw>& laws;
  const Eigen::VectorXd& change_of_a;
  const Eigen::VectorXd& change_of_b;
  const StoppedPair& stopped;
};

/// Stores the memory of the points of a pair, and the record of the step. @param work of the step, J
/// @param bulge of both blocks, m
void remember(const RunContext& run, const AcceptedPair& accepted, const TimeScheme& scheme, double work,
              double bulge) {
  const auto& [pair, response, laws, ya, yb, stopped] = accepted;
  const SimulationSettings& settings = run.settings();
  auto gaps = pair.gaps(ya, yb);
  const double deepest = deepest_of(gaps);
  run.state.report.penetration = std::max(run.state.report.penetration, deepest);
  const double tearing_gap = settings.tearing_gap();
  std::vector<PointMemory> remembered = pair.memory_after(response, laws, ya, yb, tearing_gap);
  pair.remember_impulses(response, laws, stopped.forces, scheme.step, remembered);
  PairHistory& history = run.state.pairs[{pair.a(), pair.b()}];
  const BondedArea bonds = pair.bonded_area(remembered);
  history.broken += bonds.lost;
  history.bonded = std::max(history.bonded, history.broken + bonds.left);
  history.cache = pair.cache();
  history.memory.store(pair.points(), std::move(remembered), deepest, ContactPair::energies(response), bulge,
                       pair.cuts(), pair.turning());
  // Forces that acted: with average-acceleration not those at the end, with multipliers impulses too.
  std::vector<PointResponse> acted = response.points;
  for (std::size_t k = 0; k < acted.size(); ++k) {
    acted[k].force = response.means[k].force;
    if (!stopped.forces.empty()) acted[k].force += stopped.forces[k];
  }
  if (settings.augmented && !scheme.is_static())
    tally_friction(acted, laws, scheme.step, run.state.extremes.sliding_friction);
  if (pair.dilates() && !scheme.is_static())
    tally_slip(pair, response, ya, yb, run.state.extremes.dilating_slip);
  history.work += work + stopped.work;
  run.state.records.push_back(
      {pair.a(), pair.b(), pair.points(), std::move(acted), std::move(gaps), history.work});
}

/// Distance of the surface of each block from its cells, measured on first use.
class Bulges {
 public:
  explicit Bulges(const RunContext& run) : run_(run) {}
  double of(int block) {
    const auto [known, is_new] = bulges_.emplace(block, 0.0);
    if (is_new)
      known->second = run_.contacts.finder().surfaces()[at(block)].bulge(run_.state.states[at(block)]);
    return known->second;
  }

 private:
  const RunContext& run_;
  std::map<int, double> bulges_;
};

/// Books the work of all contacts and ties, and stores the contact memory.
void take_over_pairs(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem,
                     PotentialSum potential) {
  const std::vector<StoppedPair> stopped = stop_at_contacts(run, scheme, problem);
  book_redetection(run, problem.pairs);
  LedgerKeeper& ledger = run.state.ledger;
  StepReport& report = run.state.report = StepReport{};
  report.step = scheme.step;
  keep_sleeping_pairs(run);
  Bulges bulges(run);
  double held_by_all = 0.0;
  for (const SleepingIsland& island : run.state.sleep.islands) held_by_all += island.held;
  double friction = 0.0, damped = 0.0;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    const IslandResult& result = problem.results[i];
    report.iterations = std::max(report.iterations, result.iterations);
    for (std::size_t n = 0; n < problem.islands[i].pairs.size(); ++n) {
      const std::size_t index = at(problem.islands[i].pairs[n]);
      const ContactPair& pair = problem.pairs[index];
      const PairResponse& response = result.responses[n];
      const Eigen::VectorXd& ya = problem.bodies[at(pair.a())].change;
      const Eigen::VectorXd& yb = problem.bodies[at(pair.b())].change;
      const double work = pair.work(response, ya, yb);
      ledger.loads_did(-pair.prescribed_work(response));
      potential.work += work;
      const double held = ContactPair::energies(response).total();
      potential.change += held - pair.start_energy();
      held_by_all += held;
      if (pair.tied()) continue;
      const double slid = pair.friction_work(response, result.laws[n], ya, yb) + pair.fracture_work(response);
      friction += slid;
      damped += ContactPair::damped(response);
      if (run.settings().augmented && scheme.is_static())
        run.state.pairs[{pair.a(), pair.b()}].taken = taken_in_statics(pair, response);
      else if (run.settings().augmented)
        take_for_multipliers(run, pair, -pair.spring_work(response, ya, yb) - slid);
      count_states(response.points, report);
      remember(run, {pair, response, result.laws[n], ya, yb, stopped[index]}, scheme, work,
               bulges.of(pair.a()) + bulges.of(pair.b()));
    }
  }
  const BoltEnergies bolts = take_over_bolts(run, scheme, problem);
  potential.work += bolts.work;
  potential.change += bolts.gained;
  friction += bolts.dissipated;
  held_by_all += bolts.held;
  ledger.springs_hold(held_by_all);
  ledger.sliding_took(friction);
  ledger.damping_took(damped);
  ledger.integrator_took(-(potential.work + potential.change + friction + damped));
}

}  // namespace

void accept(const RunContext& run, const TimeScheme& scheme, StepProblem& problem) {
  run.factors.drop_unused();
  run.contacts.finder().accept_motion();
  const bool gives_spin_back =
      !scheme.mean_contacts && !scheme.is_static() && !run.system.free_bodies().empty();
  std::vector<BlockState> before;
  if (gives_spin_back) before = run.state.states;
  PotentialSum potential;
  const std::vector<double> dissipated = move_blocks(run, scheme, problem, potential);
  if (gives_spin_back) keep_angular_momentum(run, scheme, problem, before, dissipated);
  take_over_pairs(run, scheme, problem, potential);
  for (auto& [block, next] : problem.carried)
    start_carried_step(run, static_cast<int>(block), std::move(next));
  run.state.clock.advance(scheme.step);
  ++run.state.steps;
  ContactExtremes& extremes = run.state.extremes;
  extremes.penetration = std::max(extremes.penetration, run.state.report.penetration);
  note_depths(run, problem.audit.depths);
  problem.audit.take_over(run.state.depths);
  note_rest(run, scheme, problem);
  run.state.ledger.close_step(run.system, run.state.states);
  drop_empty(run.state.pairs);
  validate(run.state.pairs, run.system.count());
}

}  // namespace ashlar

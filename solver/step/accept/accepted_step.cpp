#include "solver/step/accept/accepted_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "geometry/index.hpp"
#include "solver/contact/contact_accounts.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/accept/accepted_bolts.hpp"
#include "solver/step/accept/accepted_motion.hpp"
#include "solver/step/accept/block_changes.hpp"
#include "solver/step/accept/velocity_contact.hpp"
#include "solver/step/detect/end_state.hpp"
#include "solver/step/detect/sleeping_islands.hpp"

namespace ashlar {
namespace {

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
    tally.due += step * laws[k].shear_strength(force[0]);
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

/// Largest depth of a pair's points, m, >= 0. Springs may be open and unloaded there.
double deepest_of(const std::vector<double>& gaps) {
  double deepest = 0.0;
  for (const double gap : gaps) deepest = std::max(deepest, -gap);
  return deepest;
}

/// Largest closure of a pair's points at the end of a step over that of their curve (NormalSpring); 0: none is closed.
double closed_share(const ContactPair& pair, const PairResponse& response, const std::vector<PointLaw>& laws,
                    const Eigen::VectorXd& ya, const Eigen::VectorXd& yb) {
  if (laws.empty() || !laws.front().normal_spring().stiffens()) return 0.0;
  const Eigen::Matrix3Xd places = pair.places(ya, yb);
  double largest = 0.0;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const double closure = response.points[k].dilation - places(0, static_cast<Eigen::Index>(k));
    largest = std::max(largest, laws[k].normal_spring().closed_share(closure));
  }
  return largest;
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

/// Distance of the surface of each block from its cells, measured on first use.
class Bulges {
 public:
  Bulges(const std::vector<BlockSurface>& surfaces, const std::vector<BlockState>& states)
      : surfaces_(surfaces), states_(states) {}
  double of(int block) {
    const auto [known, is_new] = bulges_.emplace(block, 0.0);
    if (is_new) known->second = surfaces_[at(block)].bulge(states_[at(block)]);
    return known->second;
  }

 private:
  const std::vector<BlockSurface>& surfaces_;
  const std::vector<BlockState>& states_;
  std::map<int, double> bulges_;
};

/// Contacts, ties and bolts of a step that enter the run.
class AcceptedContacts {
 public:
  AcceptedContacts(const BlockSystem& system, RunState& state, const StepProblem& problem)
      : system_(system), state_(state), problem_(problem), scheme_(problem.scheme) {}

  /// Books the work of all contacts and ties, and stores the contact memory.
  /// @param stopped by pair of the problem. @param surfaces,potential of the blocks
  void take_over(const std::vector<StoppedPair>& stopped, const std::vector<BlockSurface>& surfaces,
                 PotentialSum potential) {
    book_redetection();
    LedgerKeeper& ledger = state_.ledger;
    StepReport& report = state_.report = StepReport{};
    report.step = scheme_.step;
    keep_sleeping_pairs();
    Bulges bulges(surfaces, state_.states);
    double held_by_all = 0.0;
    for (const SleepingIsland& island : state_.sleep.islands) held_by_all += island.held;
    double friction = 0.0, damped = 0.0;
    for (std::size_t i = 0; i < problem_.islands.size(); ++i) {
      const IslandResult& result = problem_.results[i];
      report.iterations = std::max(report.iterations, result.iterations);
      for (std::size_t n = 0; n < problem_.islands[i].pairs.size(); ++n) {
        const std::size_t index = at(problem_.islands[i].pairs[n]);
        const ContactPair& pair = problem_.pairs[index];
        const PairResponse& response = result.responses[n];
        const Eigen::VectorXd& ya = problem_.bodies[at(pair.a())].change;
        const Eigen::VectorXd& yb = problem_.bodies[at(pair.b())].change;
        const double work = pair.work(response, ya, yb);
        if (!system_.owns_pair(pair.a(), pair.b())) {
          if (pair.tied()) continue;
          remember({pair, response, result.laws[n], ya, yb, stopped[index]}, work,
                   bulges.of(pair.a()) + bulges.of(pair.b()));
          continue;
        }
        ledger.loads_did(-pair.prescribed_work(response));
        potential.work += work;
        const double held = ContactPair::energies(response).total();
        potential.change += held - pair.start_energy();
        held_by_all += held;
        if (pair.tied()) continue;
        const double slid =
            pair.friction_work(response, result.laws[n], ya, yb) + pair.fracture_work(response);
        friction += slid;
        damped += ContactPair::damped(response);
        if (system_.settings().augmented && scheme_.is_static())
          state_.pairs[{pair.a(), pair.b()}].spent = taken_in_statics(pair, response);
        else if (system_.settings().augmented)
          take_for_multipliers(pair, -pair.spring_work(response, ya, yb) - slid);
        count_states(response.points, report);
        remember({pair, response, result.laws[n], ya, yb, stopped[index]}, work,
                 bulges.of(pair.a()) + bulges.of(pair.b()));
      }
    }
    const BoltEnergies bolts = take_over_bolts(system_, state_, problem_);
    potential.work += bolts.work;
    potential.change += bolts.gained;
    friction += bolts.dissipated;
    held_by_all += bolts.held;
    ledger.springs_hold(held_by_all);
    ledger.sliding_took(friction);
    ledger.damping_took(damped);
    ledger.integrator_took(-(potential.work + potential.change + friction + damped));
  }

 private:
  /// True if one of two blocks moves; contacts between other blocks stay as they were.
  [[nodiscard]] bool is_live(int a, int b) const {
    return system_.moving()[at(a)] || system_.moving()[at(b)];
  }

  /// Books the change of spring energy due to re-detected contacts since the end of the last step.
  void book_redetection() {
    // Springs of one pair may replace those of another one.
    double change = 0.0;
    std::set<PairKey> going_on;  // their springs, like ties, are the same as before
    for (const ContactPair& pair : problem_.pairs) {
      if (pair.continues())
        going_on.insert({pair.a(), pair.b()});
      else if (!pair.tied() && system_.owns_pair(pair.a(), pair.b()))
        change += pair.start_energy();
    }
    for (const PairRecord& record : state_.records) {
      if (!is_live(record.a, record.b) || going_on.count({record.a, record.b}) > 0) continue;
      if (!system_.owns_pair(record.a, record.b)) continue;
      for (const PointResponse& response : record.responses) change -= response.energy();
    }
    state_.ledger.found_anew(change);
  }

  /// Adds energy that the blocks of a pair have spent on multipliers to its account. Energy released beyond the account
  /// is booked as gained. @param work J; negative: released
  void take_for_multipliers(const ContactPair& pair, double work) {
    state_.ledger.multipliers_gave(book(work, state_.pairs[{pair.a(), pair.b()}].spent));
  }

  /// Keeps records of pairs whose blocks do not move, with their part of the report, and drops the others.
  void keep_sleeping_pairs() {
    StepReport& report = state_.report;
    for (auto& [blocks, pair] : state_.pairs)
      if (is_live(blocks[0], blocks[1])) {
        pair.memory = ContactMemory();
        if (pair.cache && !pair.cache->found.points.empty()) pair.cache.reset();
      }
    std::erase_if(state_.records, [this](const PairRecord& record) { return is_live(record.a, record.b); });
    for (const PairRecord& record : state_.records) {
      if (!system_.owns_pair(record.a, record.b)) continue;
      count_states(record.responses, report);
      report.penetration = std::max(report.penetration, deepest_of(record.gaps));
    }
  }

  /// Stores the memory of the points of a pair, and the record of the step. @param work of the step, J
  /// @param bulge of both blocks, m
  void remember(const AcceptedPair& accepted, double work, double bulge) {
    const auto& [pair, response, laws, ya, yb, stopped] = accepted;
    const SimulationSettings& settings = system_.settings();
    auto gaps = pair.gaps(ya, yb);
    const double deepest = deepest_of(gaps);
    state_.report.penetration = std::max(state_.report.penetration, deepest);
    const double tearing_gap = settings.tearing_gap();
    std::vector<PointMemory> remembered = pair.memory_after(response, laws, ya, yb, tearing_gap);
    pair.remember_impulses(response, laws, stopped.forces, scheme_.step, remembered);
    PairHistory& history = state_.pairs[{pair.a(), pair.b()}];
    const BondedArea bonds = pair.bonded_area(remembered);
    history.broken += bonds.lost;
    history.bonded = std::max(history.bonded, history.broken + bonds.left);
    history.cache = pair.cache();
    history.memory.store(pair.points(), std::move(remembered), deepest, ContactPair::energies(response),
                         bulge, pair.cuts(), pair.turning());
    // Forces that acted: with average-acceleration not those at the end, with multipliers impulses too.
    std::vector<PointResponse> acted = response.points;
    for (std::size_t k = 0; k < acted.size(); ++k) {
      acted[k].force = response.means[k].force;
      if (!stopped.forces.empty()) acted[k].force += stopped.forces[k];
    }
    const bool owned = system_.owns_pair(pair.a(), pair.b());
    if (owned && settings.augmented && !scheme_.is_static())
      tally_friction(acted, laws, scheme_.step, state_.extremes.sliding_friction);
    if (owned && pair.dilates() && !scheme_.is_static())
      tally_slip(pair, response, ya, yb, state_.extremes.dilating_slip);
    if (const double share = owned ? closed_share(pair, response, laws, ya, yb) : 0.0;
        share > state_.extremes.most_closed.share)
      state_.extremes.most_closed = {{pair.a(), pair.b()}, share, state_.time() + scheme_.step};
    history.work += work + stopped.work;
    state_.records.push_back(
        {pair.a(), pair.b(), pair.points(), std::move(acted), std::move(gaps), history.work});
  }

  const BlockSystem& system_;
  RunState& state_;
  const StepProblem& problem_;
  const TimeScheme& scheme_;
};

}  // namespace

void accept(BlockSystem& system, RunState& state, StepCaches& caches, StepProblem&& problem) {
  const TimeScheme& scheme = problem.scheme;
  ContactFinder& finder = caches.contacts.finder();
  caches.factors.drop_unused();
  finder.accept_motion();
  const PotentialSum of_blocks = move_blocks(system, state, problem);
  tell_states(system, state);
  const std::vector<StoppedPair> stopped = stop_at_contacts(system, state, caches.factors.islands, problem);
  AcceptedContacts(system, state, problem).take_over(stopped, finder.surfaces(), of_blocks);
  for (auto& [block, next] : problem.carried)
    start_carried_step(system, state, caches, static_cast<int>(block), std::move(next));
  state.clock.advance(scheme.step);
  ++state.steps;
  ContactExtremes& extremes = state.extremes;
  extremes.penetration = std::max(extremes.penetration, state.report.penetration);
  note_depths(system, state, problem.audit.depths);
  problem.audit.take_over(state.depths);
  system.exchange().tell_contacts(system, state);
  note_rest(system, state, finder, problem);
  state.ledger.close_step(system, state.states);
  drop_empty(state.pairs);
  validate(state.pairs, system.count());
}

}  // namespace ashlar

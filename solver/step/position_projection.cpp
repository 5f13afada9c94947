#include "solver/step/position_projection.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "solver/contact/contact_accounts.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/step/applied_force.hpp"
#include "solver/step/block_changes.hpp"

#include "solver/step/velocity_contact.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

constexpr double inertia_share = 0.01;  // of the inertia in a step: blocks move rather than strain

/// An island whose blocks are moved.
struct MovedIsland {
  const Island* island;
  std::size_t place;  // in the funds
  double energy;      // required by its motion, J
  Vector3 momentum;   // angular, before
};

/// Energy that a motion without velocity requires: of elasticity and gravity less the work of loads, J.
double energy_of_motion(const BlockSystem& system, const RunState& state, const Island& island,
                        const std::vector<BodyStep>& bodies) {
  double energy = 0.0;
  for (const int k : island.bodies) {
    const Eigen::MatrixX3d motion = bodies[at(k)].motion();
    const BlockModel& block = system.blocks()[at(k)];
    energy +=
        block.elastic(state.states[at(k)].position + motion).energy - state.ledger.elastic_energy(k) -
        motion.cwiseProduct(block.external_force(system.settings().gravity_at(state.time()), state.time()))
            .sum();
  }
  return energy;
}

/// The problem of separating blocks: pairs without friction, bodies without motion of their own.
StepProblem pose(const BlockSystem& system, const RunState& state, const std::vector<ContactPair>& pairs) {
  // The same distance is kept for the deformation of springs in this motion.
  const double pushed_from =
      system.settings().multipliers.share * system.settings().multipliers.penetration_tolerance;
  StepProblem problem;
  for (const ContactPair& pair : pairs) problem.pairs.push_back(pair.projected(pushed_from));
  problem.islands = find_islands(system.moving(), problem.pairs);
  problem.bodies.resize(system.blocks().size());
  for (int k = 0; k < system.count(); ++k) {
    BodyStep& body = problem.bodies[at(k)];
    body.model = &system.blocks()[at(k)];
    body.state = &state.states[at(k)];
    body.roundoff_force = system.roundoff_force(k);
    body.free_change = body.change = Eigen::VectorXd::Zero(body.model->unknowns());
  }
  return problem;
}

/// Islands with a point that is too deep. @param tolerated m
std::vector<const Island*> deep_islands(const std::vector<Island>& islands,
                                        const std::vector<ContactPair>& pairs, double tolerated) {
  std::vector<const Island*> deep;
  for (const Island& island : islands) {
    if (std::any_of(island.pairs.begin(), island.pairs.end(),
                    [&](int index) { return pairs[at(index)].depth_found() > tolerated; }))
      deep.push_back(&island);
  }
  return deep;
}

/// Scheme of a motion between two steps. @param step s
TimeScheme scheme_of_motion(double step) {
  TimeScheme scheme;
  scheme.kind = StepKind::statics;
  scheme.inertia = inertia_share * 2.0 / (step * step);
  return scheme;
}

/// The smallest motion that separates the blocks of deep points.
class Separation {
 public:
  /// @param pairs of the step; used as long as this
  Separation(const BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs)
      : system_(system),
        state_(state),
        pairs_(pairs),
        problem_(pose(system, state, pairs)),
        deep_(deep_islands(problem_.islands, pairs, system.settings().multipliers.tolerated_depth())),
        funds_(state.pairs, contacts_of_islands()),
        relaxed_(system.blocks().size()) {}

  /// Its pairs, bodies and islands.
  [[nodiscard]] StepProblem& problem() { return problem_; }

  /// Computes the motion of each deep island, scaled to its energy account. @return true if any moves
  [[nodiscard]] bool solve(IslandSolvers& solvers, double step) {
    const TimeScheme scheme = scheme_of_motion(step);
    SimulationSettings settings = system_.settings();
    settings.statics.residual_tolerance = settings.multipliers.apart_residual;
    for (std::size_t n = 0; n < deep_.size(); ++n) {
      const Stopwatch watch(state_.log.seconds.solve);
      const Island& island = *deep_[n];
      relax(island);
      const IslandResult result =
          solve_island(island, problem_.bodies, problem_.pairs, scheme, settings, solvers);
      state_.log.counts.open_close_iterations += static_cast<std::uint64_t>(result.iterations);
      scale(n, scheme, result.status == IslandStatus::converged);
    }
    // Bodies outlive their relaxed states.
    for (std::size_t k = 0; k < relaxed_.size(); ++k) problem_.bodies[k].state = &state_.states[k];
    return !moved_.empty();
  }

  /// Applies the motion and books it.
  void apply() {
    LedgerKeeper& ledger = state_.ledger;
    for (int k = 0; k < system_.count(); ++k) {
      if (!system_.moving()[at(k)]) continue;
      const Eigen::MatrixX3d motion = problem_.bodies[at(k)].motion();
      ledger.loads_did(
          motion.cwiseProduct(applied_force(system_.blocks()[at(k)], system_.settings(), state_.time()))
              .sum());
      state_.states[at(k)].position += motion;
      ledger.measure_elastic(system_, state_.states, k);
    }
    for (const MovedIsland& moved : moved_) book(moved);
    funds_.spend_from(state_.pairs);
  }

 private:
  [[nodiscard]] std::vector<std::vector<PairKey>> contacts_of_islands() const {
    std::vector<std::vector<PairKey>> contacts;
    contacts.reserve(deep_.size());
    for (const Island* island : deep_) contacts.push_back(contacts_of(*island, pairs_));
    return contacts;
  }

  /// Lets the blocks of an island start without strain.
  void relax(const Island& island) {
    for (const int k : island.bodies) {
      BodyStep& body = problem_.bodies[at(k)];
      const BlockModel& block = *body.model;
      relaxed_[at(k)] = state_.states[at(k)];
      // Under stress, blocks of small inertia would turn rather than move.
      if (block.space().can_turn() && block.incremental() == nullptr)
        relaxed_[at(k)].position = block.unstrained(state_.states[at(k)].position);
      body.state = &relaxed_[at(k)];
      body.external_force = block.space().restrict(block.elastic(body.state->position).force);
    }
  }

  /// Scales the motion of a deep island to its account, which is charged. @param settled false: there is no motion
  void scale(std::size_t place, const TimeScheme& scheme, bool settled) {
    const Island& island = *deep_[place];
    double energy = energy_of_motion(system_, state_, island, problem_.bodies);
    const double limit = funds_.available(place);
    const double share = !settled ? 0.0 : energy > limit ? limit / energy : 1.0;
    for (const int k : island.bodies) {
      problem_.bodies[at(k)].change *= share;
      problem_.bodies[at(k)].follow_rigid(scheme);
    }
    if (share == 0.0) return;
    if (share < 1.0) energy = energy_of_motion(system_, state_, island, problem_.bodies);
    funds_.use(place, std::min(energy, limit));
    moved_.push_back(
        {&island, place, energy, angular_momentum_of(system_.blocks(), island.bodies, state_.states)});
  }

  /// Books the energy of a moved island and returns its spin.
  void book(const MovedIsland& moved) {
    LedgerKeeper& ledger = state_.ledger;
    ledger.integrator_took(-moved.energy);
    if (!is_free(system_, *moved.island, pairs_)) return;
    const std::vector<int>& bodies = moved.island->bodies;
    const Vector3 lost = moved.momentum - angular_momentum_of(system_.blocks(), bodies, state_.states);
    const double gain =
        add_spin(system_.blocks(), bodies, lost, funds_.available(moved.place), state_.states);
    funds_.use(moved.place, gain);
    ledger.integrator_took(-gain);
  }

  const BlockSystem& system_;
  RunState& state_;
  const std::vector<ContactPair>& pairs_;
  StepProblem problem_;
  std::vector<const Island*> deep_;  ///< of the problem
  IslandFunds funds_;
  std::vector<BlockState> relaxed_;  ///< by block, states of bodies while they are solved
  std::vector<MovedIsland> moved_;
};

}  // namespace

bool too_deep(const BlockSystem& system, const RunState& state, const std::vector<ContactPair>& pairs) {
  return system.settings().augmented && state.has_begun() &&
         std::any_of(pairs.begin(), pairs.end(), [&](const ContactPair& pair) {
           return pair.depth_found() > system.settings().multipliers.tolerated_depth();
         });
}

bool project_positions(BlockSystem& system, RunState& state, StepCaches& caches, double step,
                       StepProblem& problem) {
  for (int additions = system.settings().multipliers.moves_apart;; --additions) {
    Separation separation(system, state, problem.pairs);
    if (!separation.solve(caches.factors.islands, step)) return false;
    StepProblem& apart = separation.problem();
    const std::vector<BlockState> after = states_after(system, state, apart);
    const auto passing = caches.contacts.check_motion(system, state, after, problem.found);
    if (passing.empty()) {
      if (!carry_blocks(system, state, apart)) return false;
      caches.contacts.finder().accept_motion();
      separation.apply();
      for (auto& [block, next] : apart.carried)
        start_carried_step(system, state, caches, static_cast<int>(block), std::move(next));
      return true;
    }
    if (additions == 0) return false;
    problem.found = with_passing(std::move(problem.found), passing);
    problem.pairs = caches.contacts.pairs(system, state, problem.found, PairUse::motion);
  }
}

}  // namespace ashlar

#include "solver/step/accept/position_projection.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/accept/block_changes.hpp"
#include "solver/step/accept/island_parts.hpp"
#include "solver/step/island/applied_force.hpp"
#include "solver/step/solve/joined_island.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

constexpr double inertia_share = 0.01;  // of the inertia in a step: blocks move rather than strain

/// An island whose blocks are moved.
struct MovedIsland {
  std::size_t place;   // among the deep ones
  double energy;       // required by its motion on all processes, J
  double energy_here;  // by that of own blocks, J
  Vector3 momentum;    // angular, of own blocks, before
};

/// Energy that a motion of own blocks without velocity requires: of elasticity and gravity less the work of loads, J.
double energy_of_motion(const BlockSystem& system, const RunState& state, const IslandPart& part,
                        const std::vector<BodyStep>& bodies) {
  double energy = 0.0;
  for (const int k : part.bodies) {
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
  problem.shared = system.exchange().join_islands(system, problem.islands);
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

/// Islands of the run with a point that is too deep. Collective. @param tolerated m
std::vector<IslandPart> deep_islands(const BlockSystem& system, const StepProblem& problem,
                                     const std::vector<ContactPair>& pairs, double tolerated) {
  std::vector<IslandPart> parts = PartsOfRun(system, problem.islands, problem.shared, pairs).parts;
  Eigen::MatrixXd deep(3, static_cast<Eigen::Index>(parts.size()));  // too deep, not free, joined
  for (std::size_t k = 0; k < parts.size(); ++k)
    deep.col(static_cast<Eigen::Index>(k)) << (parts[k].depth > tolerated ? 1.0 : 0.0),
        (parts[k].free ? 0.0 : 1.0), (parts[k].joined ? 1.0 : 0.0);
  sum_of_run(system, deep);
  std::vector<IslandPart> result;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (!(deep(0, column) > 0.0)) continue;
    parts[k].free = deep(1, column) == 0.0;
    parts[k].joined = deep(2, column) > 0.0;
    result.push_back(std::move(parts[k]));
  }
  return result;
}

/// The bodies and pairs of the joined island whose islands are too deep.
Island deep_part(const BlockSystem& system, const Island& joined, const std::vector<ContactPair>& pairs,
                 const std::vector<IslandPart>& deep) {
  const std::map<int, int> first = system.exchange().first_blocks(system, joined, pairs);
  const auto is_deep = [&](int block) {
    const int name = first.at(block);
    return std::any_of(deep.begin(), deep.end(), [&](const IslandPart& part) { return part.first == name; });
  };
  Island result;
  for (const int block : joined.bodies)
    if (is_deep(block)) result.bodies.push_back(block);
  for (const int index : joined.pairs) {
    const ContactPair& pair = pairs[at(index)];
    if (is_deep(system.moving()[at(pair.a())] ? pair.a() : pair.b())) result.pairs.push_back(index);
  }
  return result;
}

std::vector<std::vector<PairKey>> contacts_of(const std::vector<IslandPart>& islands) {
  std::vector<std::vector<PairKey>> contacts;
  contacts.reserve(islands.size());
  for (const IslandPart& island : islands) contacts.push_back(island.contacts);
  return contacts;
}

/// Scheme of a motion between two steps. @param step s
TimeScheme scheme_of_motion(double step) {
  TimeScheme scheme;
  scheme.kind = StepKind::statics;
  scheme.inertia = inertia_share * 2.0 / (step * step);
  return scheme;
}

/// The smallest motion that separates the blocks of deep points. With several processes all of it is collective.
class Separation {
 public:
  /// @param pairs of the step; used as long as this
  Separation(const BlockSystem& system, RunState& state, const std::vector<ContactPair>& pairs)
      : system_(system),
        state_(state),
        problem_(pose(system, state, pairs)),
        deep_(deep_islands(system, problem_, pairs, system.settings().multipliers.tolerated_depth())),
        shared_(shared_accounts(system)),
        funds_(state.pairs, contacts_of(deep_), shared_ ? &*shared_ : nullptr),
        relaxed_(system.blocks().size()) {}

  /// Its pairs, bodies and islands.
  [[nodiscard]] StepProblem& problem() { return problem_; }

  /// Computes the motion of each deep island, scaled to its energy account. @return true if any moves
  [[nodiscard]] bool solve(IslandSolvers& solvers, double step) {
    const TimeScheme scheme = scheme_of_motion(step);
    SimulationSettings settings = system_.settings();
    settings.statics.residual_tolerance = settings.multipliers.apart_residual;
    std::vector<bool> converged(deep_.size(), true);
    {
      const Stopwatch watch(state_.log.seconds.solve);
      solve_islands(solvers, scheme, settings, converged);
    }
    scale(scheme, converged);
    tell_changes(system_, problem_.bodies);
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
      if (system_.owns(k))
        ledger.loads_did(
            motion.cwiseProduct(applied_force(system_.blocks()[at(k)], system_.settings(), state_.time()))
                .sum());
      state_.states[at(k)].position += motion;
      ledger.measure_elastic(system_, state_.states, k);
    }
    book();
    funds_.spend_from(state_.pairs);
    tell_states(system_, state_);
  }

 private:
  void solve_islands(IslandSolvers& solvers, const TimeScheme& scheme, const SimulationSettings& settings,
                     std::vector<bool>& converged) {
    const auto count = [&](const IslandResult& result) {
      state_.log.counts.open_close_iterations += static_cast<std::uint64_t>(result.iterations);
      return result.status == IslandStatus::converged;
    };
    bool any_joined = false;
    std::map<int, const Island*> of_first;
    for (const Island& island : problem_.islands)
      if (!island.bodies.empty()) of_first.emplace(island.bodies.front(), &island);
    for (std::size_t n = 0; n < deep_.size(); ++n) {
      any_joined = any_joined || deep_[n].joined;
      if (deep_[n].joined || deep_[n].bodies.empty()) continue;
      const Island& island = *of_first.at(deep_[n].first);
      relax(island);
      converged[n] = count(solve_island(island, problem_.bodies, problem_.pairs, scheme, settings, solvers));
    }
    if (!any_joined) return;
    const Island joined = deep_part(system_, problem_.islands[at(problem_.shared)], problem_.pairs, deep_);
    relax(joined);
    const bool all =
        count(solve_joined_island(system_, joined, problem_.bodies, problem_.pairs, scheme, settings));
    for (std::size_t n = 0; n < deep_.size(); ++n)
      if (deep_[n].joined) converged[n] = all;
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

  /// Scales the motions of deep islands to their accounts, which are charged. @param converged those that are not have
  /// no motion
  void scale(const TimeScheme& scheme, const std::vector<bool>& converged) {
    Eigen::MatrixXd sums(2, static_cast<Eigen::Index>(deep_.size()));  // not converged, energy
    std::vector<double> here;
    for (std::size_t n = 0; n < deep_.size(); ++n) {
      here.push_back(energy_of_motion(system_, state_, deep_[n], problem_.bodies));
      sums.col(static_cast<Eigen::Index>(n)) << (converged[n] ? 0.0 : 1.0), here[n];
    }
    sum_of_run(system_, sums);
    for (std::size_t n = 0; n < deep_.size(); ++n) {
      double energy = sums(1, static_cast<Eigen::Index>(n));
      const double limit = funds_.available(n);
      const bool moves = sums(0, static_cast<Eigen::Index>(n)) == 0.0;
      const double share = !moves ? 0.0 : energy > limit ? limit / energy : 1.0;
      for (const int k : deep_[n].bodies) {
        problem_.bodies[at(k)].change *= share;
        problem_.bodies[at(k)].follow_rigid(scheme);
      }
      if (share == 0.0) continue;
      if (share < 1.0) {
        here[n] = energy_of_motion(system_, state_, deep_[n], problem_.bodies);
        Eigen::MatrixXd sum = Eigen::MatrixXd::Constant(1, 1, here[n]);
        sum_of_run(system_, sum);
        energy = sum(0, 0);
      }
      funds_.use(n, std::min(energy, limit));
      moved_.push_back(
          {n, energy, here[n], angular_momentum_of(system_.blocks(), deep_[n].bodies, state_.states)});
    }
  }

  /// Books the energies of moved islands and returns the spin of free ones.
  void book() {
    std::vector<std::vector<int>> bodies;
    Eigen::MatrixXd lost(3, static_cast<Eigen::Index>(moved_.size()));
    for (std::size_t n = 0; n < moved_.size(); ++n) {
      const std::vector<int>& own = bodies.emplace_back(deep_[moved_[n].place].bodies);
      lost.col(static_cast<Eigen::Index>(n)) =
          moved_[n].momentum - angular_momentum_of(system_.blocks(), own, state_.states);
    }
    sum_of_run(system_, lost);
    std::vector<Vector3> momenta;
    for (Eigen::Index n = 0; n < lost.cols(); ++n) momenta.emplace_back(lost.col(n));
    const std::vector<Spin> spins =
        spins_of(system_.blocks(), bodies, momenta, state_.states, summed_over_processes(system_));
    LedgerKeeper& ledger = state_.ledger;
    for (std::size_t n = 0; n < moved_.size(); ++n) {
      const IslandPart& island = deep_[moved_[n].place];
      ledger.integrator_took(-moved_[n].energy_here);
      if (!island.free) continue;
      const double share = spins[n].share_within(funds_.available(moved_[n].place));
      spins[n].add(share, system_.blocks(), bodies[n], state_.states);
      funds_.use(moved_[n].place, spins[n].gain(share));
      // The energy of the whole island is booked by one process.
      if (system_.owns(island.first)) ledger.integrator_took(-spins[n].gain(share));
    }
  }

  const BlockSystem& system_;
  RunState& state_;
  StepProblem problem_;
  std::vector<IslandPart> deep_;  ///< of the problem
  std::optional<SharedAccounts> shared_;
  IslandFunds funds_;
  std::vector<BlockState> relaxed_;  ///< by block, states of bodies while they are solved
  std::vector<MovedIsland> moved_;
};

}  // namespace

bool too_deep(const BlockSystem& system, const RunState& state, const std::vector<ContactPair>& pairs) {
  if (!system.settings().augmented || !state.has_begun()) return false;
  const double tolerated = system.settings().multipliers.tolerated_depth();
  return any_of_run(system, std::any_of(pairs.begin(), pairs.end(), [&](const ContactPair& pair) {
                      return pair.depth_of_multipliers() > tolerated;
                    }));
}

bool project_positions(BlockSystem& system, RunState& state, StepCaches& caches, double step,
                       StepProblem& problem) {
  for (int additions = system.settings().multipliers.moves_apart;; --additions) {
    Separation separation(system, state, problem.pairs);
    if (!separation.solve(caches.factors.islands, step)) return false;
    StepProblem& apart = separation.problem();
    const std::vector<BlockState> after = states_after(system, state, apart);
    auto passing = caches.contacts.check_motion(system, state, after, problem.found);
    std::erase_if(passing, [&](const PassingBlocks& pair) {
      return !system.owns_pair(pair.blocks[0], pair.blocks[1]);
    });
    if (!any_of_run(system, !passing.empty())) {
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

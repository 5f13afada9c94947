#include "solver/step/accept/velocity_contact.hpp"

#include <algorithm>
#include <optional>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/accept/island_parts.hpp"
#include "solver/step/island/island_equations.hpp"
#include "solver/step/island/island_tangent.hpp"
#include "solver/step/island/joined_system.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// Loss of kinetic energy and angular momentum by the impulses on a part of an island.
struct ImpulseLoss {
  bool stopped = false;                ///< false: there were no impulses
  double energy = 0.0;                 ///< J
  Vector3 momentum = Vector3::Zero();  ///< kg m^2/s
};

/// Releases points whose tensile impulse would exceed their compressive one. @return true if there are any
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

/// Takes rows of pairs that were updated to the end of the step.
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

/// A step whose blocks have been moved.
struct EndedStep {
  const BlockSystem& system;
  RunState& state;  ///< at its end
  const StepProblem& problem;
  std::vector<BodyStep> bodies;  ///< by block: models, states and zero changes
};

EndedStep ended_step(const BlockSystem& system, RunState& state, const StepProblem& problem) {
  EndedStep ended{system, state, problem, std::vector<BodyStep>(system.blocks().size())};
  for (std::size_t k = 0; k < ended.bodies.size(); ++k) {
    ended.bodies[k].model = &system.blocks()[k];
    ended.bodies[k].state = &state.states[k];
    ended.bodies[k].change = Eigen::VectorXd::Zero(system.blocks()[k].unknowns());
    ended.bodies[k].prescribed = problem.bodies[k].prescribed;
  }
  return ended;
}

/// The impulses of one island.
class IslandImpulses {
 public:
  /// @param sums of the solver
  IslandImpulses(EndedStep& ended, std::size_t island, IslandSolvers::Entry& solver, const IslandSums& sums)
      : system_(ended.system),
        state_(ended.state),
        step_(ended.problem.scheme.step),
        island_(ended.problem.islands[island]),
        pairs_(ended.problem.pairs),
        result_(ended.problem.results[island]),
        bodies_(ended.bodies),
        scheme_(impulsive(step_)),
        problem_(island_, bodies_, pairs_, scheme_, system_.settings(), solver, sums),
        velocities_(bodies_.size()) {
    const TimeScheme& of_step = ended.problem.scheme;
    act_at_end(island_, pairs_, result_, bodies_, problem_);
    for (const int index : island_.pairs) let_go_.emplace_back(pairs_[at(index)].points().size(), false);
    set_velocities(1.0 / of_step.end_velocity.change - 0.5 * step_);
  }

  /// @return true if there are any impulses: a system that cannot be factorised has none
  [[nodiscard]] bool find() {
    const std::vector<Eigen::VectorXd> start = velocities_;
    do {
      velocities_ = start;
      for (const int k : island_.bodies) bodies_[at(k)].change.setZero();
      problem_.set_responses(impulses());
      IslandTangent tangent(problem_);
      if (tangent.factorize() != FactorStatus::success) return false;
      problem_.apply(tangent.solve(problem_.contact_forces(), false), 1.0);
      for (const int k : island_.bodies) velocities_[at(k)] += bodies_[at(k)].change;
      found_ = impulses();
    } while (problem_.sums().any(let_go_of_pulls(island_, pairs_, result_, found_, let_go_)));
    return true;
  }

  /// Changes velocities. @param stopped of the island's pairs, and losses of its parts, are written
  void apply(const PartsOfRun& parts, std::vector<StoppedPair>& stopped, std::vector<ImpulseLoss>& losses) {
    const std::vector<BlockModel>& blocks = system_.blocks();
    std::vector<BlockState>& states = state_.states;
    const auto each_part = [&](const auto& act) {
      for (const std::size_t k : parts.of_island(island_))
        act(losses[k], angular_momentum_of(blocks, parts.parts[k].bodies, states));
    };
    each_part([](ImpulseLoss& loss, const Vector3& momentum) { loss = {true, 0.0, momentum}; });
    for (const int k : island_.bodies) {
      const BlockModel& block = blocks[at(k)];
      const double before = block.kinetic_energy(states[at(k)]);
      states[at(k)].velocity += block.space().expand(bodies_[at(k)].change) / step_;
      if (!system_.owns(k)) continue;
      double& lost = losses[parts.part_of(k)].energy;
      lost += before;
      lost -= block.kinetic_energy(states[at(k)]);
    }
    // Mean velocities over the impulse determine its work.
    for (const int k : island_.bodies)
      velocities_[at(k)] =
          step_ * blocks[at(k)].space().restrict(states[at(k)].velocity) - 0.5 * bodies_[at(k)].change;
    for (std::size_t n = 0; n < island_.pairs.size(); ++n) {
      const ContactPair& pair = problem_.pair(n);
      const double of_supports = record(n, stopped[at(island_.pairs[n])]);
      if (!system_.owns_pair(pair.a(), pair.b())) continue;
      state_.ledger.loads_did(-of_supports);
      const int block = system_.moving()[at(pair.a())] ? pair.a() : pair.b();
      losses[parts.part_of(block)].energy -= of_supports;
    }
    // Opposite impulses act at places that differ by the gap.
    each_part([](ImpulseLoss& loss, const Vector3& momentum) { loss.momentum -= momentum; });
  }

 private:
  static TimeScheme impulsive(double step) {
    TimeScheme scheme;
    scheme.impulsive = true;
    scheme.force_weight = 0.0;
    scheme.inertia = 1.0 / (step * step);
    return scheme;
  }

  /// u times the step. @param shift beta/gamma dt - dt/2, 0 but with generalized-alpha
  void set_velocities(double shift) {
    for (const int k : island_.bodies) {
      Eigen::MatrixX3d velocity = state_.states[at(k)].velocity;
      if (!state_.accelerations.empty()) velocity -= shift * state_.accelerations[at(k)];
      velocities_[at(k)] = step_ * system_.blocks()[at(k)].space().restrict(velocity);
    }
  }

  [[nodiscard]] double inertia(int block) const {
    return system_.blocks()[at(block)].material().density * scheme_.inertia;
  }

  /// Impulses of each pair at the present velocities.
  [[nodiscard]] std::vector<PairResponse> impulses() const {
    const MultiplierSettings& settings = system_.settings().multipliers;
    std::vector<PairResponse> responses;
    for (std::size_t n = 0; n < island_.pairs.size(); ++n) {
      const ContactPair& pair = problem_.pair(n);
      const Stop stop{settings.stop_stiffness, inertia(pair.a()), inertia(pair.b()),
                      settings.share * settings.penetration_tolerance};
      responses.push_back(pair.stopping(result_.responses[n], result_.laws[n], velocities_[at(pair.a())],
                                        velocities_[at(pair.b())], stop, let_go_[n]));
    }
    return responses;
  }

  /// Records the effect of a pair's impulses. @return work of moving supports against them, J
  [[nodiscard]] double record(std::size_t n, StoppedPair& stopped) const {
    const ContactPair& pair = problem_.pair(n);
    const std::vector<ContactPoint>& points = pairs_[at(island_.pairs[n])].points();
    for (std::size_t k = 0; k < points.size(); ++k)
      stopped.forces.push_back(in_frame(points[k], out_of_frame(pair.points()[k], found_[n].means[k].force)));
    stopped.work = pair.work(found_[n], velocities_[at(pair.a())], velocities_[at(pair.b())]);
    return pair.prescribed_work(found_[n]);
  }

  const BlockSystem& system_;
  RunState& state_;
  double step_;  ///< s
  const Island& island_;
  const std::vector<ContactPair>& pairs_;
  const IslandResult& result_;
  std::vector<BodyStep>& bodies_;
  TimeScheme scheme_;
  IslandProblem problem_;
  std::vector<Eigen::VectorXd> velocities_;  ///< by block, times the step
  std::vector<std::vector<bool>> let_go_;    ///< by pair of the island and point
  std::vector<PairResponse> found_;
};

/// Impulses of one island. @param is_shared true: of the joined one, collective
void stop_island(EndedStep& ended, std::size_t n, bool is_shared, IslandSolvers& solvers,
                 const PartsOfRun& parts, std::vector<StoppedPair>& stopped,
                 std::vector<ImpulseLoss>& losses) {
  const StepProblem& problem = ended.problem;
  const Island& island = problem.islands[n];
  const IslandResult& result = problem.results[n];
  bool pushes = false;
  for (std::size_t k = 0; k < island.pairs.size() && !pushes; ++k)
    pushes = problem.pairs[at(island.pairs[k])].pushes(result.responses[k], result.laws[k]);
  std::unique_ptr<JoinedSystem> linear;
  if (is_shared) {
    pushes = any_of_run(ended.system, pushes);
    if (pushes)
      linear =
          ended.system.exchange().joined_system(ended.system, island, ended.bodies, problem.pairs, nullptr);
  }
  if (!pushes) return;
  IslandSolvers::Entry& solver =
      linear ? linear->solver() : solver_of(island, ended.bodies, problem.pairs, SystemRole::stop, solvers);
  IslandImpulses stop(ended, n, solver, linear ? linear->sums() : IslandSums::of_one_process());
  if (stop.find()) stop.apply(parts, stopped, losses);
}

/// Returns the angular momentum of free islands, for energy that impulses and contacts have dissipated, and books losses.
void book_losses(const BlockSystem& system, RunState& state, const std::vector<IslandPart>& parts,
                 const std::vector<ImpulseLoss>& losses) {
  Eigen::MatrixXd sums(6, static_cast<Eigen::Index>(parts.size()));  // stopped, not free, energy, momentum
  for (std::size_t k = 0; k < parts.size(); ++k)
    sums.col(static_cast<Eigen::Index>(k)) << (losses[k].stopped ? 1.0 : 0.0), (parts[k].free ? 0.0 : 1.0),
        losses[k].energy, losses[k].momentum;
  sum_of_run(system, sums);
  std::vector<std::vector<int>> bodies;
  std::vector<Vector3> momenta;
  const auto spins_at = [&](Eigen::Index k) { return sums(0, k) > 0.0 && sums(1, k) == 0.0; };
  for (Eigen::Index k = 0; k < sums.cols(); ++k) {
    if (!spins_at(k)) continue;
    bodies.push_back(parts[static_cast<std::size_t>(k)].bodies);
    momenta.emplace_back(sums.col(k).tail<3>());
  }
  const std::vector<Spin> spins =
      spins_of(system.blocks(), bodies, momenta, state.states, summed_over_processes(system));
  const std::optional<SharedAccounts> shared = shared_accounts(system);
  for (std::size_t k = 0, next = 0; k < parts.size(); ++k) {
    double lost = losses[k].energy;
    if (spins_at(static_cast<Eigen::Index>(k))) {
      const Spin& spin = spins[next];
      const double own = std::max(0.0, sums(2, static_cast<Eigen::Index>(k)));
      double share = 1.0;
      if (spin.gain(1.0) > own) {
        IslandFunds funds(state.pairs, {parts[k].contacts}, shared ? &*shared : nullptr);
        share = spin.share_within(own + funds.available(0));
        funds.use(0, std::max(0.0, spin.gain(share) - own));
        funds.spend_from(state.pairs);
      }
      spin.add(share, system.blocks(), bodies[next++], state.states);
      // Energies of the whole island are booked by one process.
      if (system.owns(parts[k].first)) lost -= spin.gain(share);
    }
    if (losses[k].stopped) state.ledger.integrator_took(lost);
  }
}

}  // namespace

std::vector<StoppedPair> stop_at_contacts(const BlockSystem& system, RunState& state, IslandSolvers& solvers,
                                          const StepProblem& problem) {
  const Stopwatch watch(state.log.seconds.solve);
  std::vector<StoppedPair> stopped(problem.pairs.size());
  if (!system.settings().augmented || problem.scheme.is_static()) return stopped;
  EndedStep ended = ended_step(system, state, problem);
  const PartsOfRun parts(system, problem.islands, problem.shared, problem.pairs);
  std::vector<ImpulseLoss> losses(parts.parts.size());
  for (std::size_t n = 0; n < problem.islands.size(); ++n)
    stop_island(ended, n, static_cast<int>(n) == problem.shared, solvers, parts, stopped, losses);
  book_losses(system, state, parts.parts, losses);
  tell_states(system, state);
  return stopped;
}

}  // namespace ashlar

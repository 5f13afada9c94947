#include "solver/step/velocity_contact.hpp"

#include <algorithm>
#include <limits>

#include "geometry/index.hpp"
#include "solver/contact/contact_accounts.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/step/island_equations.hpp"
#include "solver/step/island_tangent.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

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

}  // namespace

bool is_free(const BlockSystem& system, const Island& island, const std::vector<ContactPair>& pairs) {
  const auto in_free_body = [&](int block) {
    return std::any_of(system.free_bodies().begin(), system.free_bodies().end(),
                       [&](const std::vector<int>& body) {
                         return std::find(body.begin(), body.end(), block) != body.end();
                       });
  };
  return std::all_of(island.bodies.begin(), island.bodies.end(), in_free_body) &&
         std::all_of(island.pairs.begin(), island.pairs.end(),
                     [&](int index) {
                       return system.moving()[at(pairs[at(index)].a())] &&
                              system.moving()[at(pairs[at(index)].b())];
                     }) &&
         std::all_of(island.bolts.begin(), island.bolts.end(), [&](const StepBolt* bolt) {
           return std::all_of(bolt->blocks().begin(), bolt->blocks().end(),
                              [&](int block) { return system.moving()[at(block)]; });
         });
}

namespace {

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
  IslandImpulses(EndedStep& ended, std::size_t island, IslandSolvers& solvers)
      : system_(ended.system),
        state_(ended.state),
        step_(ended.problem.scheme.step),
        island_(ended.problem.islands[island]),
        pairs_(ended.problem.pairs),
        result_(ended.problem.results[island]),
        bodies_(ended.bodies),
        scheme_(impulsive(step_)),
        problem_(island_, bodies_, pairs_, scheme_, system_.settings(),
                 solver_of(island_, bodies_, pairs_, SystemRole::stop, solvers)),
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
    } while (let_go_of_pulls(island_, pairs_, result_, found_, let_go_));
    return true;
  }

  /// Changes velocities and books their energy loss. @param stopped of the island's pairs is written
  void apply(std::vector<StoppedPair>& stopped) {
    const std::vector<BlockModel>& blocks = system_.blocks();
    std::vector<BlockState>& states = state_.states;
    const Vector3 momentum = angular_momentum_of(blocks, island_.bodies, states);
    double lost = 0.0;
    for (const int k : island_.bodies) {
      const BlockModel& block = blocks[at(k)];
      lost += block.kinetic_energy(states[at(k)]);
      states[at(k)].velocity += block.space().expand(bodies_[at(k)].change) / step_;
      lost -= block.kinetic_energy(states[at(k)]);
    }
    // Mean velocities over the impulse determine its work.
    for (const int k : island_.bodies)
      velocities_[at(k)] =
          step_ * blocks[at(k)].space().restrict(states[at(k)].velocity) - 0.5 * bodies_[at(k)].change;
    for (std::size_t n = 0; n < island_.pairs.size(); ++n) lost -= record(n, stopped[at(island_.pairs[n])]);
    if (is_free(system_, island_, pairs_)) {
      // Opposite impulses act at places that differ by the gap.
      const Vector3 missing = momentum - angular_momentum_of(blocks, island_.bodies, states);
      const double own = std::max(0.0, lost);
      IslandFunds funds(state_.pairs, {contacts_of(island_, pairs_)});
      const double gain = add_spin(blocks, island_.bodies, missing, own + funds.available(0), states);
      funds.use(0, std::max(0.0, gain - own));
      funds.spend_from(state_.pairs);
      lost -= gain;
    }
    state_.ledger.integrator_took(lost);
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
    const double of_supports = pair.prescribed_work(found_[n]);
    state_.ledger.loads_did(-of_supports);
    return of_supports;
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

}  // namespace

std::vector<StoppedPair> stop_at_contacts(const BlockSystem& system, RunState& state, IslandSolvers& solvers,
                                          const StepProblem& problem) {
  const Stopwatch watch(state.log.seconds.solve);
  std::vector<StoppedPair> stopped(problem.pairs.size());
  if (!system.settings().augmented || problem.scheme.is_static()) return stopped;
  EndedStep ended = ended_step(system, state, problem);
  for (std::size_t n = 0; n < problem.islands.size(); ++n) {
    const Island& island = problem.islands[n];
    const IslandResult& result = problem.results[n];
    bool pushes = false;
    for (std::size_t k = 0; k < island.pairs.size() && !pushes; ++k)
      pushes = problem.pairs[at(island.pairs[k])].pushes(result.responses[k], result.laws[k]);
    if (!pushes) continue;
    IslandImpulses stop(ended, n, solvers);
    if (stop.find()) stop.apply(stopped);
  }
  return stopped;
}

}  // namespace ashlar

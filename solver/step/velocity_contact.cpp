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

/// The impulses of one island.
class IslandImpulses {
 public:
  /// @param of_step the step that has ended. @param bodies models, states and zero changes
  IslandImpulses(const RunContext& run, const TimeScheme& of_step, const StepProblem& step_problem,
                 std::size_t island, std::vector<BodyStep>& bodies)
      : run_(run),
        step_(of_step.step),
        island_(step_problem.islands[island]),
        pairs_(step_problem.pairs),
        result_(step_problem.results[island]),
        bodies_(bodies),
        scheme_(impulsive(of_step.step)),
        problem_(island_, bodies_, pairs_, scheme_, run.settings(),
                 solver_of(island_, bodies_, pairs_, SystemRole::stop, run.factors.islands)),
        velocities_(bodies.size()) {
    act_at_end(island_, pairs_, result_, bodies_, problem_);
    for (const int index : island_.pairs) let_go_.emplace_back(pairs_[at(index)].points().size(), false);
    set_velocities(1.0 / of_step.end_velocity.change - 0.5 * of_step.step);
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
    const std::vector<BlockModel>& blocks = run_.blocks();
    std::vector<BlockState>& states = run_.state.states;
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
    if (is_free(run_.system, island_, pairs_)) {
      // Opposite impulses act at places that differ by the gap.
      const Vector3 missing = momentum - angular_momentum_of(blocks, island_.bodies, states);
      const double own = std::max(0.0, lost);
      IslandFunds funds(run_.state.pairs, {contacts_of(island_, pairs_)});
      const double gain = add_spin(blocks, island_.bodies, missing, own + funds.available(0), states);
      funds.use(0, std::max(0.0, gain - own));
      funds.spend_from(run_.state.pairs);
      lost -= gain;
    }
    run_.state.ledger.integrator_took(lost);
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
      Eigen::MatrixX3d velocity = run_.state.states[at(k)].velocity;
      if (!run_.state.accelerations.empty()) velocity -= shift * run_.state.accelerations[at(k)];
      velocities_[at(k)] = step_ * run_.blocks()[at(k)].space().restrict(velocity);
    }
  }

  [[nodiscard]] double inertia(int block) const {
    return run_.blocks()[at(block)].material().density * scheme_.inertia;
  }

  /// Impulses of each pair at the present velocities.
  [[nodiscard]] std::vector<PairResponse> impulses() const {
    const MultiplierSettings& settings = run_.settings().multipliers;
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
    run_.state.ledger.loads_did(-of_supports);
    return of_supports;
  }

  const RunContext& run_;
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

std::vector<StoppedPair> stop_at_contacts(const RunContext& run, const TimeScheme& scheme,
                                          const StepProblem& problem) {
  const Stopwatch watch(run.state.log.seconds.solve);
  std::vector<StoppedPair> stopped(problem.pairs.size());
  if (!run.settings().augmented || scheme.is_static()) return stopped;
  std::vector<BodyStep> bodies(run.blocks().size());
  for (std::size_t k = 0; k < run.blocks().size(); ++k) {
    bodies[k].model = &run.blocks()[k];
    bodies[k].state = &run.state.states[k];
    bodies[k].change = Eigen::VectorXd::Zero(run.blocks()[k].unknowns());
    bodies[k].prescribed = problem.bodies[k].prescribed;
  }
  for (std::size_t n = 0; n < problem.islands.size(); ++n) {
    const Island& island = problem.islands[n];
    const IslandResult& result = problem.results[n];
    bool pushes = false;
    for (std::size_t k = 0; k < island.pairs.size() && !pushes; ++k)
      pushes = problem.pairs[at(island.pairs[k])].pushes(result.responses[k], result.laws[k]);
    if (!pushes) continue;
    IslandImpulses stop(run, scheme, problem, n, bodies);
    if (stop.find()) stop.apply(stopped);
  }
  return stopped;
}

}  // namespace ashlar

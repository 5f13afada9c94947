// Where contact is augmented, multipliers hold points at the depth where they are found. What a step does not
// see, corners and faces that turn while it moves them straight, adds to that depth from step to step. Blocks
// that are deeper in each other than the tolerance allows are therefore moved apart between two steps, by the
// least motion that does it: they keep their velocities. To push them apart within a step would give them a
// velocity of depth over step.
//
// The motion lifts weights and strains blocks a little. It takes no more energy for that than contacts have
// taken from blocks before (contact_accounts.hpp). Free blocks that move apart as they pass each other would
// have another angular momentum: the set of them gets it back as a spin.
#include <algorithm>

#include "geometry/index.hpp"
#include "solver/run/simulation.hpp"
#include "solver/step/angular_momentum.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

constexpr double inertia_share = 0.01;  // of that of a step: blocks move rather than strain

}  // namespace

double Simulation::energy_of_motion(const std::vector<int>& island,
                                    const std::vector<BodyStep>& bodies) const {
  double energy = 0.0;
  for (const int k : island) {
    const Eigen::MatrixX3d motion = bodies[at(k)].motion();
    const BlockModel& block = blocks_[at(k)];
    energy += block.elastic(states_[at(k)].position + motion).energy - elastic_energies_[at(k)] -
              motion.cwiseProduct(block.external_force(settings_.gravity, time())).sum();
  }
  return energy;
}

bool Simulation::is_free(const Island& island, const std::vector<ContactPair>& pairs) const {
  const auto in_free_body = [&](int block) {
    return std::any_of(free_bodies_.begin(), free_bodies_.end(), [&](const std::vector<int>& body) {
      return std::find(body.begin(), body.end(), block) != body.end();
    });
  };
  return std::all_of(island.bodies.begin(), island.bodies.end(), in_free_body) &&
         std::all_of(island.pairs.begin(), island.pairs.end(), [&](int index) {
           return moving_[at(pairs[at(index)].a())] && moving_[at(pairs[at(index)].b())];
         });
}

bool Simulation::too_deep(const std::vector<ContactPair>& pairs) const {
  return settings_.augmented && has_begun() &&
         std::any_of(pairs.begin(), pairs.end(), [&](const ContactPair& pair) {
           return pair.depth_found() > settings_.tolerated_depth();
         });
}

bool Simulation::move_apart(double step, std::vector<ContactPair>& pairs, std::vector<FoundContacts>& found,
                            int additions) {
  // As much is left for what springs give way by in this motion.
  const double pushed_from = settings_.multiplier_share * settings_.penetration_tolerance;
  TimeScheme scheme;
  scheme.from_rest = true;
  scheme.inertia = inertia_share * 2.0 / (step * step);
  SimulationSettings settings = settings_;
  settings.static_residual_tolerance = settings_.apart_residual;
  Trial trial;
  for (const ContactPair& pair : pairs) trial.pairs.push_back(pair.moved_apart(pushed_from));
  trial.islands = find_islands(moving_, trial.pairs);
  trial.bodies.resize(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    BodyStep& body = trial.bodies[k];
    body.model = &blocks_[k];
    body.state = &states_[k];
    body.roundoff_force = roundoff_force_[k];
    body.free_change = body.change = Eigen::VectorXd::Zero(blocks_[k].unknowns());
  }
  std::vector<BlockState> relaxed(blocks_.size());  // of blocks that are moved
  struct MovedIsland {
    const Island* island;
    std::size_t place;  // in the funds
    double energy;      // that its motion takes
    Vector3 momentum;   // angular, before
  };
  std::vector<const Island*> deep;
  std::vector<std::vector<PairKey>> contacts;
  for (const Island& island : trial.islands) {
    double deepest = 0.0;
    for (const int index : island.pairs) deepest = std::max(deepest, pairs[at(index)].depth_found());
    if (deepest <= settings_.tolerated_depth()) continue;
    deep.push_back(&island);
    contacts.push_back(contacts_of(island, pairs));
  }
  IslandFunds funds(taken_, std::move(contacts));
  std::vector<MovedIsland> moved;
  for (std::size_t n = 0; n < deep.size(); ++n) {
    const Stopwatch watch(seconds_.solve);
    const Island& island = *deep[n];
    for (const int k : island.bodies) {
      BodyStep& body = trial.bodies[at(k)];
      const BlockModel& block = blocks_[at(k)];
      relaxed[at(k)] = states_[at(k)];
      // Under stress, blocks that hardly have inertia would rather turn than move.
      if (block.space().can_turn() && block.incremental() == nullptr)
        relaxed[at(k)].position = block.unstrained(states_[at(k)].position);
      body.state = &relaxed[at(k)];
      body.external_force = block.space().restrict(block.elastic(body.state->position).force);
    }
    const IslandResult result = solve_island(island, trial.bodies, trial.pairs, scheme, settings, solvers_);
    counts_.open_close_iterations += static_cast<std::uint64_t>(result.iterations);
    double energy = energy_of_motion(island.bodies, trial.bodies);
    const double limit = funds.available(n);
    const bool settled = result.status == IslandStatus::settled;
    const double share = !settled ? 0.0 : energy > limit ? limit / energy : 1.0;
    for (const int k : island.bodies) trial.bodies[at(k)].change *= share;
    if (share == 0.0) continue;
    if (share < 1.0) energy = energy_of_motion(island.bodies, trial.bodies);
    funds.use(n, std::min(energy, limit));
    moved.push_back({&island, n, energy, angular_momentum_of(blocks_, island.bodies, states_)});
  }
  if (moved.empty()) return false;
  if (const auto passing = check_motion(trial, found); !passing.empty()) {
    if (additions == 0) return false;
    add_contacts(passing, found);
    pairs = make_pairs(found, true);
    return move_apart(step, pairs, found, additions - 1);
  }
  if (!carry_blocks(trial)) return false;
  finder_.accept_motion();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k]) continue;
    const Eigen::MatrixX3d motion = trial.bodies[k].motion();
    ledger_.applied += motion.cwiseProduct(blocks_[k].load_force(time())).sum();
    states_[k].position += motion;
    note_elastic_energy(k);
  }
  for (const auto& [island, place, energy, momentum] : moved) {
    ledger_.numerical -= energy;
    if (!is_free(*island, pairs)) continue;
    const double gain =
        add_spin(blocks_, island->bodies, momentum - angular_momentum_of(blocks_, island->bodies, states_),
                 funds.available(place), states_);
    funds.use(place, gain);
    ledger_.numerical -= gain;
  }
  funds.spend_from(taken_);
  for (auto& [block, next] : trial.carried) start_carried_step(block, std::move(next));
  return true;
}

}  // namespace ashlar

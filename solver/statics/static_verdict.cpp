#include "solver/statics/static_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "mechanics/basis/field_moments.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/rigid_onset.hpp"

namespace ashlar {
namespace {

/// Iterations of a cycle: displacements of unstable blocks grow by factors, so that they are seen by then.
constexpr int repeating_iterations = 16;
/// Largest residual in a cycle, of the largest force on its block.
constexpr double repeating_share = 1e-8;

/// Share of settings.statics.displacement_limit: blocks with this displacement at the last iteration are moving
/// slowly.
constexpr double slow_share = 0.1;
/// Share of settings.statics.displacement_limit: least displacement of blocks moved along by others, or sinking due
/// to their motion. Blocks with merely increased contact forces have moved less.
constexpr double taken_along_share = 1e-3;

/// Changes of joints in an iteration.
struct Joints {
  std::vector<PairKey> sliding;  ///< blocks that slide on each other
  bool fail = false;             ///< true if any joint fails
};

/// @param tearing_gap of the settings, m
Joints joints_of(const StepProblem& problem, double tearing_gap) {
  Joints joints;
  const auto change = [&](int block) { return problem.bodies[at(block)].change; };
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    for (std::size_t n = 0; n < problem.islands[i].pairs.size(); ++n) {
      const ContactPair& pair = problem.pairs[static_cast<std::size_t>(problem.islands[i].pairs[n])];
      if (pair.tied()) continue;
      const PairResponse& response = problem.results[i].responses[n];
      const auto any = [&](ContactState state) {
        return std::any_of(response.points.begin(), response.points.end(),
                           [&](const PointResponse& point) { return point.state == state; });
      };
      // Where pressure ends, some points slide independently of the motion of the blocks.
      if (any(ContactState::sliding) && !any(ContactState::locked))
        joints.sliding.push_back({pair.a(), pair.b()});
      joints.fail =
          joints.fail || pair.fails(pair.memory_after(response, problem.results[i].laws[n], change(pair.a()),
                                                      change(pair.b()), tearing_gap));
    }
  }
  std::sort(joints.sliding.begin(), joints.sliding.end());
  return joints;
}

/// Processes evaluate the accelerations of their own blocks. Collective. @param accelerations by block, (p, 3)
void tell_accelerations(const BlockSystem& system, std::vector<Eigen::MatrixX3d>& accelerations) {
  system.exchange().tell_neighbours([&](ByteWriter& writer, int block) { writer(accelerations[at(block)]); },
                                    [&](ByteReader& reader, int block) { reader(accelerations[at(block)]); });
}

}  // namespace

double largest_motion(const Island& island, const std::vector<BodyStep>& bodies) {
  double most = 0.0;
  for (const int k : island.bodies) {
    const BodyStep& body = bodies[at(k)];
    const double motion = mean_motion(*body.model, body.model->space().expand(body.change));
    most = std::max(most, motion / body.model->size());
  }
  return most;
}

double largest_motion(const StepProblem& problem) {
  double most = 0.0;
  for (const Island& island : problem.islands) most = std::max(most, largest_motion(island, problem.bodies));
  return most;
}

bool multipliers_repeat(const BlockSystem& system, const StepProblem& problem) {
  double change = 0.0;
  double largest = 0.0;
  for (const IslandResult& result : problem.results) {
    for (std::size_t pair = 0; pair < result.laws.size(); ++pair) {
      for (std::size_t k = 0; k < result.laws[pair].size(); ++k) {
        const PointLaw& law = result.laws[pair][k];
        const Eigen::Vector3d& force = result.responses[pair].points[k].force;
        largest = std::max(largest, force.norm());
        if (!law.augmented) continue;
        const Eigen::Vector3d held(law.normal_multiplier, law.shear_multiplier[0], law.shear_multiplier[1]);
        change = std::max(change, (force - held).norm());
      }
    }
  }
  return most_of_run(system, change) <=
         system.settings().statics.multiplier_tolerance * most_of_run(system, largest);
}

bool has_set_off(const BlockSystem& system, const StaticState& statics) {
  const double least = taken_along_share * system.settings().statics.displacement_limit;
  const std::vector<double>& displacements = statics.progress.displacements;
  return any_of_run(system, std::any_of(displacements.begin(), displacements.end(),
                                        [least](double displacement) { return displacement > least; }));
}

bool has_converged(const BlockSystem& system, const StepProblem& problem) {
  return all_of_run(system, std::none_of(problem.bodies.begin(), problem.bodies.end(),
                                         [](const BodyStep& body) { return body.residual > 0.0; }));
}

/// Acceleration that an iteration of a block lacks for balance, times density, N m^-3/2.
double lacking_force(const BlockSystem& system, const StepProblem& problem, std::size_t block) {
  const BodyStep& body = problem.bodies[block];
  return system.blocks()[block].material().density * problem.scheme.inertia * body.change.norm() +
         body.residual;
}

bool note_balance(const BlockSystem& system, RunState& state, const StepProblem& problem) {
  bool balanced = true;
  const std::vector<bool> held = system.held_without_contacts();
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    if (!system.moving()[k] || !system.owns(static_cast<int>(k))) continue;
    const BodyStep& body = problem.bodies[k];
    const BlockModel& block = system.blocks()[k];
    const double lacking = lacking_force(system, problem, k);
    const Eigen::MatrixX3d position = state.states[k].position + body.motion();
    if (lacking <= system.settings().statics.tolerance * body.largest_force + body.roundoff_force) {
      state.statics.progress.displacements[k] = 0.0;
      state.statics.progress.positions[k] = position;
      state.statics.progress.forces[k] = lacking;
      continue;
    }
    balanced = false;
    if (lacking < 0.5 * state.statics.progress.forces[k]) {
      state.statics.progress.positions[k] = position;
      state.statics.progress.forces[k] = lacking;
    }
    state.statics.progress.displacements[k] =
        mean_motion(block, position - state.statics.progress.positions[k]) / block.size();
    if (state.statics.progress.displacements[k] > system.settings().statics.displacement_limit && !held[k])
      state.statics.moving = true;
  }
  state.statics.moving = any_of_run(system, state.statics.moving);
  return all_of_run(system, balanced);
}

bool repeats_motion(const BlockSystem& system, RunState& state, const StepProblem& problem, bool calm) {
  StaticCycle& cycle = state.statics.cycle;
  double travel = 0.0;  // since the start of the cycle, in block sizes
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    if (!system.moving()[k] || !system.owns(static_cast<int>(k))) continue;
    const BodyStep& body = problem.bodies[k];
    calm = calm &&
           lacking_force(system, problem, k) <= repeating_share * body.largest_force + body.roundoff_force;
    if (cycle.positions.empty()) continue;
    const Eigen::MatrixX3d position = state.states[k].position + body.motion();
    travel = std::max(
        travel, mean_motion(system.blocks()[k], position - cycle.positions[k]) / system.blocks()[k].size());
  }
  if (!all_of_run(system, calm)) {
    cycle = {};
    return false;
  }
  ++cycle.iterations;
  if (!cycle.positions.empty() && cycle.iterations < repeating_iterations) return false;
  const bool came_back =
      !cycle.positions.empty() && most_of_run(system, travel) <= system.settings().statics.stillness;
  cycle.positions.clear();
  for (std::size_t k = 0; k < system.blocks().size(); ++k) {
    const bool moves = system.moving()[k] && system.owns(static_cast<int>(k));
    cycle.positions.emplace_back(state.states[k].position);
    if (moves) cycle.positions.back() += problem.bodies[k].motion();
  }
  cycle.iterations = 0;
  return came_back;
}

void forget_accelerations(RunState& state) {
  state.statics.onset.least_residual = std::numeric_limits<double>::infinity();
  state.statics.onset.unbalanced.clear();
  state.statics.onset.rigid = false;
  state.statics.onset.is_compliant.assign(state.states.size(), 0);
  state.statics.onset.starts.clear();
  for (const BlockState& block : state.states) state.statics.onset.starts.push_back(block.position);
}

double displacement_since_onset(const BlockSystem& system, const RunState& state, int block) {
  return mean_motion(system.blocks()[at(block)],
                     state.states[at(block)].position - state.statics.onset.starts[at(block)]);
}

void note_accelerations(const BlockSystem& system, RunState& state, IslandSolvers& solvers,
                        const StepProblem& problem) {
  auto [sliding, fail] = joints_of(problem, system.settings().tearing_gap());
  if (any_of_run(system, fail)) forget_accelerations(state);
  const bool converged =
      has_converged(system, problem) && all_of_run(system, sliding == state.statics.onset.sliding);
  state.statics.onset.sliding = std::move(sliding);
  // Until the same joints slide twice, the last iteration is the best: in the first ones inertia carries most of the
  // weight.
  if (!converged && std::isfinite(state.statics.onset.least_residual)) return;
  bool near_start = true;
  for (int k = 0; k < system.count(); ++k)
    near_start =
        near_start && !(system.moving()[at(k)] && system.owns(k) &&
                        displacement_since_onset(system, state, k) > system.settings().contact_distance);
  near_start = all_of_run(system, near_start);
  if (!near_start && state.statics.onset.rigid) return;
  std::vector<Eigen::MatrixX3d> accelerations(system.blocks().size());
  for (std::size_t k = 0; k < system.blocks().size(); ++k)
    if (system.moving()[k])
      accelerations[k] = problem.scheme.inertia * system.blocks()[k].space().expand(problem.bodies[k].change);
  if (converged) {
    const bool rigid = starts_rigidly(system, state, solvers, problem, accelerations);
    double lacking = 0.0;
    for (std::size_t k = 0; k < system.blocks().size(); ++k)
      if (system.owns(static_cast<int>(k)))
        lacking += (system.blocks()[k].material().density * accelerations[k]).squaredNorm();
    lacking = sum_of_run(system, lacking);
    if (!(lacking < state.statics.onset.least_residual)) return;
    state.statics.onset.least_residual = lacking;
    state.statics.onset.rigid = rigid;
  }
  tell_accelerations(system, accelerations);
  state.statics.onset.unbalanced = std::move(accelerations);
}

StaticStatus give_up(const BlockSystem& system, StaticState& statics) {
  // A small residual may still produce a large, slow displacement.
  const std::vector<bool> held = system.held_without_contacts();
  for (std::size_t k = 0; k < system.blocks().size(); ++k)
    statics.moving =
        statics.moving || (!held[k] && statics.progress.displacements[k] >
                                           slow_share * system.settings().statics.displacement_limit);
  statics.moving = any_of_run(system, statics.moving);
  return statics.moving ? StaticStatus::moving : StaticStatus::not_converged;
}

MovingBlocks moving_blocks(const BlockSystem& system, const RunState& state) {
  const std::vector<bool> held = system.held_without_contacts();
  MovingBlocks moving;
  for (std::size_t k = 0; k < state.statics.progress.displacements.size(); ++k) {
    const BlockModel& block = system.blocks()[k];
    if (!system.moving()[k] || held[k] || !system.owns(static_cast<int>(k)) ||
        state.statics.progress.displacements[k] <=
            taken_along_share * system.settings().statics.displacement_limit)
      continue;
    if (state.statics.onset.unbalanced.empty()) {
      moving.later.push_back({static_cast<int>(k), Vector3::Zero(), Vector3::Zero()});
      continue;
    }
    const Eigen::MatrixX3d& a = state.statics.onset.unbalanced[k];
    const Eigen::Matrix3d gradient = a.transpose() * block.basis().gradients(block.basis().centroid());
    const Vector3 turn = 0.5 * Vector3(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                                       gradient(1, 0) - gradient(0, 1));
    (a.isZero(0.0) ? moving.later : moving.first)
        .push_back({static_cast<int>(k), mean_of(a, block.basis().volume()), turn});
  }
  return moving;
}

std::vector<MovingBlock> moving_of_run(const BlockSystem& system, const RunState& state) {
  const MovingBlocks own = moving_blocks(system, state);
  MovingBlocks moving{joined_of_run(system, own.first), joined_of_run(system, own.later)};
  std::vector<MovingBlock>& told = moving.first.empty() ? moving.later : moving.first;
  std::sort(told.begin(), told.end(),
            [](const MovingBlock& x, const MovingBlock& y) { return x.block < y.block; });
  return std::move(told);
}

}  // namespace ashlar

#include "solver/statics/rigid_onset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/index.hpp"
#include "solver/state/automatic.hpp"
#include "solver/statics/static_verdict.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {

namespace {

constexpr double way = 1e-5;           // motion of the fastest block, in its sizes
constexpr double strain_share = 1e-4;  // of the way
constexpr double depth_share = 1e-4;   // of the way
/// Relative to the compliant motion, or to the other blocks in motion: blocks with less motion are at rest except for
/// the motion of their contacts.
constexpr double least_share = 1e-3;
constexpr double opened_by = 4.0;  // times the mean displacement of blocks: largest gap it may have opened

/// Factor on the stiffness of a block that limits its strain under its forces to strain_share.
double stiffening(const BodyStep& body) {
  const double stress =
      body.largest_force / std::sqrt(body.model->basis().volume()) * block_size(*body.model);
  return stress / (strain_share * way * body.model->material().young_modulus);
}

/// True if the springs of all contacts of an island represent rigid contact.
bool is_rigid(const Island& island, const std::vector<ContactPair>& pairs) {
  return std::all_of(island.pairs.begin(), island.pairs.end(),
                     [&](int index) { return pairs[at(index)].rigid(); });
}

/// Extremes over the bodies at the onset of motion.
struct Onset {
  double smallest = std::numeric_limits<double>::infinity();  // block size, m
  double stiffer = 0.0;                                       // largest factor on stiffness
  double farthest = 0.0;                                      // mean motion since the start, m
};

Onset prepare(const RunContext& run, const Island& island, const StepProblem& problem,
              std::vector<BlockState>& states, std::vector<BodyStep>& bodies) {
  Onset onset;
  for (const int k : island.bodies) {
    onset.farthest = std::max(onset.farthest, displacement_since_onset(run, k));
    onset.smallest = std::min(onset.smallest, block_size(run.blocks()[at(k)]));
    onset.stiffer = std::max(onset.stiffer, stiffening(problem.bodies[at(k)]));
  }
  for (const int k : island.bodies) {
    states[at(k)].position = run.blocks()[at(k)].unstrained(run.state.states[at(k)].position);
    BodyStep& body = bodies[at(k)];
    body.state = &states[at(k)];
    body.prescribed.resize(0, 3);
    // The weight applies to external and elastic forces.
    body.external_force /= onset.stiffer;
    body.roundoff_force *= onset.stiffer;
  }
  return onset;
}

/// Replaces accelerations influenced by compliance by those of rigid blocks.
/// @param bodies as solved, in a step of this inertia. @return true if the rigid blocks move
bool take_over(const RunContext& run, const Island& island, const std::vector<BodyStep>& bodies,
               double inertia, std::vector<Eigen::MatrixX3d>& accelerations) {
  std::vector<Eigen::MatrixX3d> rigid_ones;
  double along = 0.0;
  double own = 0.0;
  double given = 0.0;
  double largest = 0.0;
  for (const int k : island.bodies) {
    const BlockModel& block = run.blocks()[at(k)];
    const double weight = std::pow(block.material().density, 2);
    rigid_ones.emplace_back(inertia * block.space().expand(bodies[at(k)].change));
    along += weight * rigid_ones.back().cwiseProduct(accelerations[at(k)]).sum();
    own += weight * rigid_ones.back().squaredNorm();
    given += weight * accelerations[at(k)].squaredNorm();
    largest = std::max(largest, mean_motion(block, rigid_ones.back()));
  }
  if (own < least_share * least_share * given) {
    for (const int k : island.bodies) run.state.statics.onset.is_compliant[at(k)] = 1;
    return false;
  }
  // Rigid blocks would only undo penetration and gaps of the deformable ones.
  if (along <= 0.0) return false;
  for (std::size_t n = 0; n < island.bodies.size(); ++n) {
    const int k = island.bodies[n];
    if (mean_motion(run.blocks()[at(k)], rigid_ones[n]) < least_share * largest) rigid_ones[n].setZero();
    accelerations[at(k)] = std::move(rigid_ones[n]);
  }
  return true;
}

}  // namespace

bool starts_rigidly(const RunContext& run, const TimeScheme& scheme, const StepProblem& problem,
                    std::vector<Eigen::MatrixX3d>& accelerations) {
  const Stopwatch watch(run.state.log.seconds.solve);
  SimulationSettings settings = run.settings();
  settings.augmented = true;
  settings.statics.residual_tolerance = run.settings().multipliers.apart_residual;
  std::vector<ContactPair> pairs = problem.pairs;
  std::vector<BodyStep> bodies = problem.bodies;
  std::vector<BlockState> states = run.state.states;
  bool all = true;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    const Island& island = problem.islands[i];
    const IslandResult& result = problem.results[i];
    const double motion = largest_motion(island, problem.bodies);
    if (island.pairs.empty() || motion == 0.0) continue;
    const bool is_compliant = std::any_of(island.bodies.begin(), island.bodies.end(), [&](int block) {
      return run.state.statics.onset.is_compliant[at(block)] != 0;
    });
    if (!is_rigid(island, pairs) || is_compliant) {
      all = false;
      continue;
    }
    const Onset onset = prepare(run, island, problem, states, bodies);
    for (std::size_t n = 0; n < island.pairs.size(); ++n) {
      ContactPair& pair = pairs[at(island.pairs[n])];
      pair = pair.at_rigid_onset(result.responses[n], result.laws[n], opened_by * onset.farthest);
    }
    TimeScheme let_go = scheme;
    let_go.inertia = scheme.inertia * motion / way;
    let_go.force_weight = onset.stiffer;
    settings.multipliers.penetration_tolerance = depth_share * way * onset.smallest;
    const IslandResult off = solve_island(island, bodies, pairs, let_go, settings, run.factors.islands);
    run.state.log.counts.open_close_iterations += static_cast<std::uint64_t>(off.iterations);
    const bool rigid = off.status == IslandStatus::converged &&
                       take_over(run, island, bodies, let_go.inertia, accelerations);
    all = all && rigid;
  }
  return all;
}

}  // namespace ashlar

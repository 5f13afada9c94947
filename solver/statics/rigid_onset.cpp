#include "solver/statics/rigid_onset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/statics/static_verdict.hpp"
#include "solver/step/solve/joined_island.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {

namespace {

constexpr double least_travel = 1e-5;  // motion of the fastest block, in its sizes
constexpr double strain_share = 1e-4;  // of the way
constexpr double depth_share = 1e-4;   // of the way
/// Relative to the compliant motion, or to the other blocks in motion: blocks with less motion are at rest except for
/// the motion of their contacts.
constexpr double least_share = 1e-3;
constexpr double opened_by = 4.0;  // times the mean displacement of blocks: largest gap it may have opened

/// Factor on the stiffness of a block that limits its strain under its forces to strain_share.
double stiffening(const BodyStep& body) {
  const double stress = body.largest_force / std::sqrt(body.model->basis().volume()) * body.model->size();
  return stress / (strain_share * least_travel * body.model->material().young_modulus);
}

/// True if the springs of all contacts of an island represent rigid contact.
bool is_rigid(const Island& island, const std::vector<ContactPair>& pairs) {
  return std::all_of(island.pairs.begin(), island.pairs.end(),
                     [&](int index) { return pairs[at(index)].rigid(); });
}

/// The bodies of an island on this process, and decisions and sums over all of its bodies. Collective for the island that
/// processes share.
class PartOfIsland {
 public:
  PartOfIsland(const BlockSystem& system, const StepProblem& problem, std::size_t index)
      : system_(system), shared_(static_cast<int>(index) == problem.shared) {
    for (const int block : problem.islands[index].bodies)
      if (system.owns(block)) own_.push_back(block);
  }
  [[nodiscard]] bool shared() const { return shared_; }
  [[nodiscard]] const std::vector<int>& own() const { return own_; }
  [[nodiscard]] bool any(bool value) const { return shared_ ? any_of_run(system_, value) : value; }
  [[nodiscard]] bool all(bool value) const { return !any(!value); }
  [[nodiscard]] double most(double value) const { return shared_ ? most_of_run(system_, value) : value; }
  [[nodiscard]] double least(double value) const { return shared_ ? least_of_run(system_, value) : value; }
  [[nodiscard]] double sum(double value) const { return shared_ ? sum_of_run(system_, value) : value; }

 private:
  const BlockSystem& system_;
  bool shared_;
  std::vector<int> own_;
};

/// Extremes over the bodies at the onset of motion.
struct Onset {
  double smallest = std::numeric_limits<double>::infinity();  // block size, m
  double stiffer = 0.0;                                       // largest factor on stiffness
  double farthest = 0.0;                                      // mean motion since the start, m
};

/// Blocks that are released from rest.
struct ReleasedBlocks {
  std::vector<BlockState> states;  ///< by block
  std::vector<BodyStep> bodies;    ///< likewise
};

Onset prepare(const BlockSystem& system, const RunState& state, const Island& island,
              const PartOfIsland& part, const StepProblem& problem, ReleasedBlocks& released) {
  Onset onset;
  for (const int k : part.own()) {
    onset.farthest = std::max(onset.farthest, displacement_since_onset(system, state, k));
    onset.smallest = std::min(onset.smallest, system.blocks()[at(k)].size());
    onset.stiffer = std::max(onset.stiffer, stiffening(problem.bodies[at(k)]));
  }
  onset = {part.least(onset.smallest), part.most(onset.stiffer), part.most(onset.farthest)};
  for (const int k : island.bodies) {
    released.states[at(k)].position = system.blocks()[at(k)].unstrained(state.states[at(k)].position);
    BodyStep& body = released.bodies[at(k)];
    body.state = &released.states[at(k)];
    body.prescribed.resize(0, 3);
    // The weight applies to external and elastic forces.
    body.external_force /= onset.stiffer;
    body.roundoff_force *= onset.stiffer;
  }
  return onset;
}

/// Accelerations of blocks of an island. @param bodies as solved, in a step of this inertia
std::vector<Eigen::MatrixX3d> accelerations_of(const std::vector<int>& blocks,
                                               const std::vector<BodyStep>& bodies, double inertia) {
  std::vector<Eigen::MatrixX3d> accelerations;
  for (const int k : blocks)
    accelerations.emplace_back(inertia * bodies[at(k)].model->space().expand(bodies[at(k)].change));
  return accelerations;
}

/// Replaces accelerations influenced by compliance by those of rigid blocks. Marks blocks of an island that rigid
/// blocks would leave at rest.
/// @param rigid_ones by own block of the island. @return true if the rigid blocks move
bool take_over(const BlockSystem& system, const PartOfIsland& island,
               std::vector<Eigen::MatrixX3d> rigid_ones, StaticOnset& onset,
               std::vector<Eigen::MatrixX3d>& accelerations) {
  double along = 0.0;
  double own = 0.0;
  double given = 0.0;
  double largest = 0.0;
  for (std::size_t n = 0; n < island.own().size(); ++n) {
    const int k = island.own()[n];
    const BlockModel& block = system.blocks()[at(k)];
    const double weight = block.material().density * block.material().density;
    along += weight * rigid_ones[n].cwiseProduct(accelerations[at(k)]).sum();
    own += weight * rigid_ones[n].squaredNorm();
    given += weight * accelerations[at(k)].squaredNorm();
    largest = std::max(largest, mean_motion(block, rigid_ones[n]));
  }
  along = island.sum(along);
  own = island.sum(own);
  given = island.sum(given);
  largest = island.most(largest);
  if (own < least_share * least_share * given) {
    for (const int k : island.own()) onset.is_compliant[at(k)] = 1;
    return false;
  }
  // Rigid blocks would only undo penetration and gaps of the deformable ones.
  if (along <= 0.0) return false;
  for (std::size_t n = 0; n < island.own().size(); ++n) {
    const int k = island.own()[n];
    if (mean_motion(system.blocks()[at(k)], rigid_ones[n]) < least_share * largest) rigid_ones[n].setZero();
    accelerations[at(k)] = std::move(rigid_ones[n]);
  }
  return true;
}

}  // namespace

bool starts_rigidly(const BlockSystem& system, RunState& state, IslandSolvers& solvers,
                    const StepProblem& problem, std::vector<Eigen::MatrixX3d>& accelerations) {
  const Stopwatch watch(state.log.seconds.solve);
  SimulationSettings settings = system.settings();
  settings.augmented = true;
  settings.statics.residual_tolerance = system.settings().multipliers.apart_residual;
  std::vector<ContactPair> pairs = problem.pairs;
  ReleasedBlocks released{state.states, problem.bodies};
  bool all = true;
  for (std::size_t i = 0; i < problem.islands.size(); ++i) {
    const Island& island = problem.islands[i];
    const IslandResult& result = problem.results[i];
    const PartOfIsland part(system, problem, i);
    const double motion = part.most(largest_motion(island, problem.bodies));
    if (!part.any(!island.pairs.empty()) || motion == 0.0) continue;
    const bool is_compliant = part.any(std::any_of(part.own().begin(), part.own().end(), [&](int block) {
      return state.statics.onset.is_compliant[at(block)] != 0;
    }));
    if (!part.all(is_rigid(island, pairs)) || is_compliant) {
      all = false;
      continue;
    }
    const Onset onset = prepare(system, state, island, part, problem, released);
    for (std::size_t n = 0; n < island.pairs.size(); ++n) {
      ContactPair& pair = pairs[at(island.pairs[n])];
      pair = pair.at_rigid_onset(result.responses[n], result.laws[n], opened_by * onset.farthest);
    }
    TimeScheme let_go = problem.scheme;
    let_go.inertia = problem.scheme.inertia * motion / least_travel;
    let_go.force_weight = onset.stiffer;
    settings.multipliers.penetration_tolerance = depth_share * least_travel * onset.smallest;
    const IslandResult off =
        part.shared() ? solve_joined_island(system, island, released.bodies, pairs, let_go, settings)
                      : solve_island(island, released.bodies, pairs, let_go, settings, solvers);
    state.log.counts.open_close_iterations += static_cast<std::uint64_t>(off.iterations);
    const bool rigid = off.status == IslandStatus::converged &&
                       take_over(system, part, accelerations_of(part.own(), released.bodies, let_go.inertia),
                                 state.statics.onset, accelerations);
    all = all && rigid;
  }
  return all_of_run(system, all);
}

}  // namespace ashlar

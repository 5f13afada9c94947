// How blocks set off that no equilibrium holds. Where contacts and blocks give way has a part in the motion
// of an iteration of a static analysis: a tipping wall rests on the strip that its springs press in, not on
// its edge. Where no stiffness of a joint was asked for, blocks are therefore let go from rest once more,
// from where the iteration found them, all but rigid: contacts that it closed give way by far less than
// blocks move, those that it opened never touch, and blocks are without strain and strain by far less than
// they move, which is too little to change how they lie. Where rigid blocks would stay, it is by giving way
// that they move, then and after.
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/index.hpp"
#include "solver/run/automatic.hpp"
#include "solver/run/simulation.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {

ContactPair ContactPair::setting_off(const PairResponse& response, const std::vector<PointLaw>& laws,
                                     double reach) const {
  ContactPair pair = *this;
  pair.prescribed_.resize(3, 0);
  pair.start_.setZero();
  for (std::size_t k = 0; !tied() && k < points_.size(); ++k) {
    PointLaw& law = pair.laws_[k];
    const PointResponse& point = response.points[k];
    const bool open = point.state == ContactState::open;
    if (open && points_[k].gap > reach)
      pair.start_(0, static_cast<Eigen::Index>(k)) = std::numeric_limits<double>::infinity();
    law.tension = open ? 0.0 : laws[k].tension;
    law.cohesion = open ? 0.0 : laws[k].cohesion;
    law.augmented = true;
    law.normal_multiplier = point.force[0];
    law.shear_multiplier = point.force.tail<2>();
  }
  pair.respond_at_start();
  return pair;
}

bool ContactPair::fails(const std::vector<PointMemory>& memory) const {
  for (std::size_t k = 0; k < memory.size(); ++k) {
    if (memory_[k].intact && !memory[k].intact && (laws_[k].cohesion > 0.0 || laws_[k].tension > 0.0))
      return true;
  }
  return false;
}

namespace {

constexpr double way = 1e-5;           // in sizes of the block that goes farthest
constexpr double strain_share = 1e-4;  // of the way
constexpr double depth_share = 1e-4;   // of the way
/// Of what blocks do that give way, or others that set off: those that do less stay, but for what their
/// contacts do.
constexpr double least_share = 1e-3;
constexpr double opened_by = 4.0;  // times the mean motion of blocks: what that may have opened

/// By how much a block would have to be stiffer so as to strain by no more than its share under its forces.
double stiffening(const BodyStep& body) {
  const double stress =
      body.largest_force / std::sqrt(body.model->basis().volume()) * block_size(*body.model);
  return stress / (strain_share * way * body.model->material().young_modulus);
}

}  // namespace

bool Simulation::set_off(const TimeScheme& scheme, const Trial& trial,
                         std::vector<Eigen::MatrixX3d>& accelerations) {
  const Stopwatch watch(seconds_.solve);
  SimulationSettings settings = settings_;
  settings.augmented = true;
  settings.static_residual_tolerance = settings_.apart_residual;
  std::vector<ContactPair> pairs = trial.pairs;
  std::vector<BodyStep> bodies = trial.bodies;
  std::vector<BlockState> states = states_;
  bool all = true;
  for (std::size_t i = 0; i < trial.islands.size(); ++i) {
    const Island& island = trial.islands[i];
    const IslandResult& result = trial.results[i];
    const double motion = largest_motion(island, trial.bodies);
    const bool rigid = std::all_of(island.pairs.begin(), island.pairs.end(),
                                   [&](int index) { return pairs[at(index)].rigid(); });
    const bool gives_way = std::any_of(island.bodies.begin(), island.bodies.end(),
                                       [&](int block) { return static_.gives_way[at(block)] != 0; });
    if (island.pairs.empty() || motion == 0.0) continue;
    all = all && rigid && !gives_way;
    if (!rigid || gives_way) continue;
    double smallest = std::numeric_limits<double>::infinity();
    double stiffer = 0.0;
    double farthest = 0.0;
    for (const int k : island.bodies) {
      farthest = std::max(farthest, travel(at(k)));
      smallest = std::min(smallest, block_size(blocks_[at(k)]));
      stiffer = std::max(stiffer, stiffening(trial.bodies[at(k)]));
    }
    for (const int k : island.bodies) {
      states[at(k)].position = blocks_[at(k)].unstrained(states_[at(k)].position);
      BodyStep& body = bodies[at(k)];
      body.state = &states[at(k)];
      body.prescribed.resize(0, 3);
      // The weight is that of external and of elastic forces.
      body.external_force /= stiffer;
      body.roundoff_force *= stiffer;
    }
    for (std::size_t n = 0; n < island.pairs.size(); ++n) {
      ContactPair& pair = pairs[at(island.pairs[n])];
      pair = pair.setting_off(result.responses[n], result.laws[n], opened_by * farthest);
    }
    TimeScheme let_go = scheme;
    let_go.inertia = scheme.inertia * motion / way;
    let_go.force_weight = stiffer;
    settings.penetration_tolerance = depth_share * way * smallest;
    const IslandResult off = solve_island(island, bodies, pairs, let_go, settings, solvers_);
    counts_.open_close_iterations += static_cast<std::uint64_t>(off.iterations);
    all = all && off.status == IslandStatus::settled;
    if (off.status != IslandStatus::settled) continue;
    std::vector<Eigen::MatrixX3d> rigid_ones;
    double along = 0.0;
    double own = 0.0;
    double given = 0.0;
    double largest = 0.0;
    for (const int k : island.bodies) {
      const BlockModel& block = blocks_[at(k)];
      const double weight = std::pow(block.material().density, 2);
      rigid_ones.emplace_back(let_go.inertia * block.space().expand(bodies[at(k)].change));
      along += weight * rigid_ones.back().cwiseProduct(accelerations[at(k)]).sum();
      own += weight * rigid_ones.back().squaredNorm();
      given += weight * accelerations[at(k)].squaredNorm();
      largest = std::max(largest, mean_motion(block, rigid_ones.back()));
    }
    const bool stay = own < least_share * least_share * given;
    if (stay)
      for (const int k : island.bodies) static_.gives_way[at(k)] = 1;
    // What they have pressed in and left open, rigid blocks would leave again.
    all = all && !stay && along > 0.0;
    if (stay || along <= 0.0) continue;
    for (std::size_t n = 0; n < island.bodies.size(); ++n) {
      const int k = island.bodies[n];
      if (mean_motion(blocks_[at(k)], rigid_ones[n]) < least_share * largest) rigid_ones[n].setZero();
      accelerations[at(k)] = std::move(rigid_ones[n]);
    }
  }
  return all;
}

}  // namespace ashlar

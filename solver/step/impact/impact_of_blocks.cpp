#include "solver/step/impact/impact_of_blocks.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {
namespace {

/// Pairs of all processes in the order of a step: contacts, then ties, each by blocks. @param own in this order
std::vector<TouchingPoints> pairs_of_run(const BlockSystem& system, const std::vector<TouchingPoints>& own) {
  std::vector<TouchingPoints> all = joined_of_run(system, own);
  std::sort(all.begin(), all.end(), [](const TouchingPoints& x, const TouchingPoints& y) {
    return std::tie(x.tied, x.blocks) < std::tie(y.tied, y.blocks);
  });
  return all;
}

}  // namespace

ImpactOfBlocks::ImpactOfBlocks(const BlockSystem& system, RunState& state,
                               const std::vector<ContactPair>& pairs)
    : system_(system),
      state_(state),
      limits_(limits_of(system.settings(), state.time())),
      pairs_(pairs),
      motions_(system, state.states),
      bonded_(system.blocks().size() + 1),
      group_(system.blocks().size()),
      meets_(system.blocks().size(), false) {}

bool ImpactOfBlocks::may_meet() {
  std::vector<std::size_t> near;
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    const ContactPair& pair = pairs_[n];
    if (!pair.restitution() || !system_.owns_pair(pair.a(), pair.b())) continue;
    for (std::size_t k = 0; k < pair.points().size(); ++k) {
      if (pair.holds(k) || pair.loaded(k) || pair.start_gap(k) > limits_.gap) continue;
      near.push_back(n);
      break;
    }
  }
  speeds_.emplace(system_, pairs_, near, limits_, motions_);
  const auto closes = [this](std::size_t n) {
    const Eigen::Matrix3Xd& velocities = motions_.at_points(pairs_[n]);
    for (std::size_t k = 0; k < pairs_[n].points().size(); ++k)
      if (speeds_->begins(pairs_[n], k, velocities(0, static_cast<Eigen::Index>(k)))) return true;
    return false;
  };
  return any_of_run(system_, std::any_of(near.begin(), near.end(), closes));
}

bool ImpactOfBlocks::find() {
  note_bonds();
  targets_.assign(pairs_.size(), {});
  std::vector<std::size_t> all(pairs_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  speeds_.emplace(system_, pairs_, all, limits_, motions_);
  std::vector<TouchingPoints> touching;
  std::vector<std::size_t> indices;
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    if (!system_.owns_pair(pairs_[n].a(), pairs_[n].b())) continue;
    const bool meets = note_touching(n);
    if (targets_[n].empty()) continue;
    touching.push_back(touching_pair(n, meets));
    indices.push_back(n);
  }
  const std::vector<TouchingPoints> of_run = pairs_of_run(system_, touching);
  for (const TouchingPoints& pair : of_run) join(pair);
  if (std::none_of(of_run.begin(), of_run.end(), [](const TouchingPoints& pair) { return pair.meets; }))
    return false;
  note_unlike(of_run);
  std::vector<TouchingPoints> struck;
  for (std::size_t k = 0; k < touching.size(); ++k) {
    if (!meets_[group_of(touching[k])]) continue;
    make_points(indices[k], touching[k]);
    struck.push_back(std::move(touching[k]));
  }
  for (const TouchingPoints& pair : pairs_of_run(system_, struck)) add(pair);
  return !points_.empty();
}

void ImpactOfBlocks::note_unlike(const std::vector<TouchingPoints>& touching) {
  std::map<std::size_t, double> first;  // by group
  unlike_ = false;
  for (const TouchingPoints& pair : touching) {
    if (!pair.meets) continue;
    const auto [entry, is_new] = first.emplace(group_of(pair), pair.restitution);
    unlike_ = unlike_ || entry->second != pair.restitution;
  }
}

void ImpactOfBlocks::apply() {
  const ImpactResult result = solve_impact(inertia_, sizes_, points_);
  ImpactTally& tally = state_.extremes.impacts;
  ++tally.count;
  if (unlike_) ++tally.unlike;
  if (result.residual > impact_accuracy) ++tally.inaccurate;
  if (result.residual > tally.residual) {
    tally.residual = result.residual;
    tally.time = state_.time();
  }
  double lost = 0.0;
  for (const auto& [block, index] : bodies_) {
    if (!system_.owns(block)) continue;
    const BlockModel& model = system_.blocks()[at(block)];
    BlockState& state = state_.states[at(block)];
    lost += model.kinetic_energy(state);
    state.velocity += model.space().expand(motions_.modes(block) * result.changes[at(index)]);
    lost -= model.kinetic_energy(state);
  }
  // Supports move against the impulses.
  double of_supports = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (own_points_[k]) of_supports -= result.impulses[k].dot(driven_[k]);
  state_.ledger.loads_did(of_supports);
  state_.ledger.damping_took(lost + of_supports);
  tell_states(system_, state_);
}

std::size_t ImpactOfBlocks::group_of(const TouchingPoints& touching) {
  return at(group_.find(touching.moves[0] != 0 ? touching.blocks[0] : touching.blocks[1]));
}

int ImpactOfBlocks::body_or_ground(int block) {
  const bool moves = motions_.moves(block) && motions_.modes(block).cols() > 0;
  return moves ? block : static_cast<int>(system_.blocks().size());
}

void ImpactOfBlocks::note_bonds() {
  std::vector<BlockPair> bonds;
  for (const ContactPair& pair : pairs_) {
    if (!system_.owns_pair(pair.a(), pair.b())) continue;
    for (std::size_t k = 0; k < pair.points().size(); ++k) {
      if (!pair.holds(k)) continue;
      bonds.push_back({body_or_ground(pair.a()), body_or_ground(pair.b())});
      break;
    }
  }
  for (const BlockPair& bond : joined_of_run(system_, bonds)) bonded_.unite(bond[0], bond[1]);
}

bool ImpactOfBlocks::note_touching(std::size_t n) {
  const ContactPair& pair = pairs_[n];
  const double fast = limits_.speed;
  const double e = pair.restitution().value_or(0.0);
  const bool apart = bonded_.find(body_or_ground(pair.a())) != bonded_.find(body_or_ground(pair.b()));
  bool meets = false;
  for (std::size_t k = 0; k < pair.points().size(); ++k) {
    if (pair.holds(k)) {
      targets_[n].push_back({k, 0.0, true});
      continue;
    }
    const bool loaded = pair.loaded(k);
    if (!loaded && pair.start_gap(k) > limits_.moment()) continue;
    const double velocity = motions_.at_points(pair)(0, static_cast<Eigen::Index>(k));
    if (!speeds_->takes_part(pair, k, velocity)) continue;
    const bool impact = pair.restitution() && apart && !loaded && -velocity > fast;
    const bool rebounds = impact && -e * velocity > limits_.rebound;
    meets = meets || (apart && speeds_->begins(pair, k, velocity));
    // A contact that bears is not loaded further, whatever its springs do.
    targets_[n].push_back({k, rebounds ? -e * velocity : impact ? 0.0 : std::min(velocity, 0.0), false});
  }
  return meets;
}

TouchingPoints ImpactOfBlocks::touching_pair(std::size_t n, bool meets) {
  const ContactPair& pair = pairs_[n];
  TouchingPoints touching{{pair.a(), pair.b()}, pair.tied(), meets, pair.restitution().value_or(0.0)};
  for (std::size_t side = 0; side < 2; ++side) {
    const int block = touching.blocks[side];
    if (!motions_.moves(block)) continue;
    touching.moves[side] = 1;
    touching.modes[side] = static_cast<int>(motions_.modes(block).cols());
    touching.inertia[side] = system_.blocks()[at(block)].material().density;
  }
  return touching;
}

void ImpactOfBlocks::join(const TouchingPoints& touching) {
  const auto [a, b] = touching.blocks;
  bool meets = touching.meets;
  for (std::size_t side = 0; side < 2; ++side)
    if (touching.moves[side] != 0) meets = meets || meets_[at(group_.find(touching.blocks[side]))];
  if (touching.moves[0] != 0 && touching.moves[1] != 0) group_.unite(a, b);
  const std::size_t group = group_of(touching);
  meets_[group] = meets_[group] || meets;
}

std::vector<Eigen::Matrix3Xd> ImpactOfBlocks::rows_of(const ContactPair& pair, int block, bool of_a) {
  std::vector<Eigen::Matrix3Xd> rows(pair.points().size());
  if (!motions_.moves(block)) return rows;
  const Eigen::MatrixXd& modes = motions_.modes(block);
  for (Eigen::Matrix3Xd& row : rows) row.resize(3, modes.cols());
  const Eigen::VectorXd rest =
      Eigen::VectorXd::Zero(system_.blocks()[at(of_a ? pair.b() : pair.a())].unknowns());
  for (Eigen::Index m = 0; m < modes.cols(); ++m) {
    const Eigen::VectorXd mode = modes.col(m);
    const Eigen::Matrix3Xd moved = of_a ? pair.rows().free_motion(mode, rest)  //
                                        : pair.rows().free_motion(rest, mode);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].col(m) = moved.col(static_cast<Eigen::Index>(k));
  }
  return rows;
}

void ImpactOfBlocks::make_points(std::size_t n, TouchingPoints& touching) {
  const ContactPair& pair = pairs_[n];
  const std::vector<Eigen::Matrix3Xd> of_a = rows_of(pair, pair.a(), true);
  const std::vector<Eigen::Matrix3Xd> of_b = rows_of(pair, pair.b(), false);
  const Eigen::Matrix3Xd& velocities = motions_.at_points(pair);
  const Eigen::Matrix3Xd own =
      pair.rows().free_motion(motions_.velocity(pair.a()), motions_.velocity(pair.b()));
  for (const PointTarget& target : targets_[n]) {
    const auto column = static_cast<Eigen::Index>(target.point);
    ImpactPoint& point = touching.points.emplace_back();
    point.of_a = of_a[target.point];
    point.of_b = of_b[target.point];
    point.velocity = velocities.col(column);
    point.target = target.target;
    point.friction = pair.laws()[target.point].friction;
    point.bonded = target.bonded;
    touching.driven.emplace_back(velocities.col(column) - own.col(column));
  }
}

int ImpactOfBlocks::body_of(const TouchingPoints& touching, std::size_t side) {
  if (touching.moves[side] == 0) return -1;
  const auto [found, is_new] = bodies_.emplace(touching.blocks[side], static_cast<int>(bodies_.size()));
  if (is_new) {
    inertia_.push_back(touching.inertia[side]);
    sizes_.push_back(touching.modes[side]);
  }
  return found->second;
}

void ImpactOfBlocks::add(const TouchingPoints& touching) {
  for (std::size_t k = 0; k < touching.points.size(); ++k) {
    ImpactPoint& point = points_.emplace_back(touching.points[k]);
    point.a = body_of(touching, 0);
    point.b = body_of(touching, 1);
    driven_.push_back(touching.driven[k]);
    own_points_.push_back(system_.owns_pair(touching.blocks[0], touching.blocks[1]));
  }
}

}  // namespace ashlar

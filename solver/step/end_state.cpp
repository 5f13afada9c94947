// What a step may end in: states that are finite, blocks that have not turned inside out, none deeper in
// another one than is allowed. Asked before a step is accepted, so that the last good state is kept.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "geometry/index.hpp"
#include "solver/run/automatic.hpp"
#include "solver/run/simulation.hpp"
#include "solver/stopwatch.hpp"

namespace ashlar {
namespace {

/// Where a block is asked whether it has turned inside out: its corners, the middles of its edges and the
/// middles of the corners of its faces. An affine block is the same everywhere.
std::vector<Vector3> asked_places(const BlockModel& block) {
  if (block.order() == 1) return {block.basis().centroid()};
  const Polyhedron& solid = block.solid();
  const auto& points = solid.mesh().points;
  std::vector<Vector3> places = {block.basis().centroid()};
  for (const int corner : solid.corners()) places.push_back(points[at(corner)]);
  for (const PolyhedronEdge& edge : solid.edges())
    places.emplace_back(0.5 * (points[at(edge.vertices[0])] + points[at(edge.vertices[1])]));
  for (const PolyhedronFace& face : solid.faces()) {
    Vector3 sum = Vector3::Zero();
    for (const int corner : face.loops.front()) sum += points[at(corner)];
    places.emplace_back(sum / static_cast<double>(face.loops.front().size()));
  }
  return places;
}

/// Gradients of the functions at these places. @return (3 #places, p)
Eigen::MatrixXd gradients_at(const BlockModel& block, const std::vector<Vector3>& places) {
  Eigen::MatrixXd gradients(3 * static_cast<Eigen::Index>(places.size()), block.basis().size());
  for (std::size_t k = 0; k < places.size(); ++k)
    gradients.middleRows(3 * static_cast<Eigen::Index>(k), 3) =
        block.basis().gradients(places[k]).transpose();
  return gradients;
}

/// Whether doubles cannot hold what a step is to do with a block or has done: a square of it that is not
/// finite, or a way so long that the block's coordinates would be rounded to more than a share of its size
/// (notes/lost_blocks.md).
bool is_lost(const BlockModel& block, const BodyStep& body, const Eigen::MatrixX3d& position, double share) {
  for (const Eigen::VectorXd* vector : {&body.external_force, &body.free_change, &body.change})
    if (!std::isfinite(vector->squaredNorm())) return true;
  if (!std::isfinite(position.squaredNorm())) return true;
  const double volume = block.basis().volume();
  const Eigen::MatrixX3d way = position - block.basis().identity_map();
  const double rounding = std::numeric_limits<double>::epsilon() * way.row(0).norm() / std::sqrt(volume);
  return rounding > share * std::cbrt(volume);
}

}  // namespace

std::vector<BlockState> Simulation::states_after(const Trial& trial) const {
  std::vector<BlockState> after = states_;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (moving_[k]) after[k].position += trial.bodies[k].motion();
  }
  return after;
}

std::optional<StateFault> Simulation::broken_block(const Trial& trial) const {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (!moving_[k]) continue;
    const Eigen::MatrixX3d position = states_[k].position + trial.bodies[k].motion();
    const int block = static_cast<int>(k);
    if (is_lost(blocks_[k], trial.bodies[k], position, settings_.lost_share))
      return StateFault{RejectionReason::not_finite, {block, block}};
    if (asked_gradients_[k] == nullptr) continue;
    const Eigen::MatrixX3d deformation = *asked_gradients_[k] * position;
    for (Eigen::Index row = 0; row < deformation.rows(); row += 3) {
      if (!(deformation.middleRows<3>(row).determinant() > 0.0))
        return StateFault{RejectionReason::inside_out, {block, block}};
    }
  }
  return std::nullopt;
}

std::vector<PairDepth> Simulation::measure_depths(const std::vector<BlockState>& states, bool fine) {
  const AuditScope scope{[this](int a, int b) { return !finder_.leaves_out(a, b); },
                         (fine ? settings_.passing_share : 1.0) * settings_.contact_distance,
                         settings_.threads};
  return audit_.run(blocks_, states, finder_.surfaces(), scope);
}

std::optional<StateFault> Simulation::too_deep_of(const std::vector<PairDepth>& depths,
                                                  const std::map<PairKey, double>& known) const {
  std::optional<StateFault> fault;
  double most = 0.0;
  const auto hold_against = [&](const PairDepth& pair, double allowed) {
    if (pair.depth - allowed <= most) return;
    most = pair.depth - allowed;
    fault = StateFault{RejectionReason::too_deep, pair.blocks, pair.depth, allowed, pair.place};
  };
  for (const PairDepth& pair : depths) {
    const auto [a, b] = std::minmax(pair.blocks[0], pair.blocks[1]);
    const auto allowed = [&, size = smaller_size({a, b})](double share) {
      return settings_.allowed_depth > 0.0 ? settings_.allowed_depth : share * size;
    };
    const auto contact = known.find({a, b});
    hold_against(pair,
                 allowed(settings_.unknown_depth_share) + (contact == known.end() ? 0.0 : contact->second));
    // A joint of given stiffness gives way as its user has asked for.
    if (law_(a, b).rigid) hold_against(pair, allowed(settings_.allowed_depth_share));
  }
  return fault;
}

std::optional<StateFault> Simulation::audit_depths(Trial& trial, bool fine) {
  const Stopwatch watch(seconds_.depth_audit);
  trial.depths = measure_depths(states_after(trial), fine);
  std::map<PairKey, double> known;
  for (const ContactPair& pair : trial.pairs) {
    if (pair.tied()) continue;
    double& deepest = known[{pair.a(), pair.b()}];
    for (const double gap : pair.gaps(trial.bodies[at(pair.a())].change, trial.bodies[at(pair.b())].change))
      deepest = std::max(deepest, -gap);
  }
  return too_deep_of(trial.depths, known);
}

std::optional<StateFault> Simulation::audit() {
  const Stopwatch watch(seconds_.depth_audit);
  std::map<PairKey, double> known;
  for (const PairRecord& pair : records_) {
    double& deepest = known[{pair.a, pair.b}];
    for (const double gap : pair.gaps) deepest = std::max(deepest, -gap);
  }
  const std::vector<PairDepth> depths = measure_depths(states_, true);
  note_depths(depths);
  return too_deep_of(depths, known);
}

double Simulation::smaller_size(const std::array<int, 2>& blocks) const {
  return std::min(block_size(blocks_[at(blocks[0])]), block_size(blocks_[at(blocks[1])]));
}

void Simulation::note_depths(const std::vector<PairDepth>& depths) {
  true_depths_.clear();
  for (const PairDepth& pair : depths) {
    const auto [a, b] = std::minmax(pair.blocks[0], pair.blocks[1]);
    double& depth = true_depths_[{a, b}];
    depth = std::max(depth, pair.depth);
    report_.depth = std::max(report_.depth, pair.depth);
    if (pair.depth > deepest_.depth)
      deepest_ = {pair.blocks, pair.depth, pair.depth / smaller_size(pair.blocks), time(), pair.place};
  }
}

void Simulation::note_gradients(std::size_t k) {
  asked_gradients_.resize(blocks_.size());
  asked_gradients_[k].reset();
  if (!moving_[k] || blocks_[k].incremental() != nullptr) return;
  for (std::size_t twin = 0; twin < k; ++twin) {
    if (asked_gradients_[twin] == nullptr || blocks_[twin].parts() != blocks_[k].parts()) continue;
    asked_gradients_[k] = asked_gradients_[twin];
    return;
  }
  asked_gradients_[k] =
      std::make_shared<const Eigen::MatrixXd>(gradients_at(blocks_[k], asked_places(blocks_[k])));
}

void Simulation::reject(double step, const StateFault& fault) {
  rejections_.push_back({time(), step, fault.reason});
  fault_ = fault;
}

void Simulation::reject_unsettled(double step, IslandStatus status, const Trial& trial) {
  // Numbers that overflow settle nowhere.
  if (const auto broken = broken_block(trial); broken && broken->reason == RejectionReason::not_finite)
    return reject(step, *broken);
  rejections_.push_back({time(), step,
                         status == IslandStatus::not_settled ? RejectionReason::open_close_not_settled
                                                             : RejectionReason::not_positive_definite});
}

}  // namespace ashlar

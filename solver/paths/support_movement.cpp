#include "solver/paths/support_movement.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/paths/followed_blocks.hpp"
#include "solver/paths/support_path.hpp"

namespace ashlar {
namespace {

/// Slip of a joint over the movement from which on a path is followed on which it slides first, and the largest number of
/// such paths: more may find a smaller range, and each costs as much as the first path.
constexpr double slid_share = 0.01;
constexpr std::size_t most_first_slides = 8;

/// Joints that have slid by more than a share of the movement, those that have slid most first, some at most.
std::vector<PairKey> slid_joints(const SupportPath& path) {
  std::vector<MovedJoint> joints = path.joints;
  std::stable_sort(joints.begin(), joints.end(),
                   [](const MovedJoint& a, const MovedJoint& b) { return a.slip > b.slip; });
  std::vector<PairKey> slid;
  for (const MovedJoint& joint : joints)
    if (joint.slip > slid_share * path.lower && slid.size() < most_first_slides) slid.push_back(joint.blocks);
  return slid;
}

/// The path with the least range of those that differ in the joint that slides first.
SupportPath least_path(SupportStart start, const MovementSearch& search) {
  SupportPath least = path_of(start, search);
  if (least.end == MovementEnd::interrupted || least.end == MovementEnd::not_determined) return least;
  double farthest = least.lower;
  for (const PairKey& joint : slid_joints(least)) {
    start.slides_first = joint;
    SupportPath other = path_of(start, search);
    other.programmes += least.programmes;
    if (other.end == MovementEnd::interrupted) return other;
    farthest = std::max(farthest, other.lower);
    if (other.lower < least.lower)
      least = std::move(other);
    else
      least.programmes = other.programmes;
  }
  if (farthest > least.lower + search.tolerance) least.farthest = farthest;
  return least;
}

}  // namespace

double extent_of(const RigidModel& model) {
  Eigen::AlignedBox3d box;
  for (const RigidPoint& point : model.points) box.extend(point.place);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::optional<int> block_held_in_part(const RigidModel& model) {
  for (const RigidBody& body : model.bodies)
    if (body.freedom < 6) return body.blocks.front();
  return std::nullopt;
}

bool is_loaded(const RigidModel& model) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.steady[b].norm() + model.multiplied[b].norm() > 0.0) return true;
  return false;
}

SupportMovement support_movement(const PlacedScene& scene, int support, const MovementSearch& search) {
  RunState placed;
  placed.states = scene.states;
  for (const auto& [blocks, history] : scene.histories) placed.pairs[blocks].overlap = history.overlap;
  const RigidModel model = rigid_model(scene.system, placed, scene.end_time, {});
  const std::vector<Bolt>& bolts = scene.system.bolts();
  if (std::any_of(bolts.begin(), bolts.end(), [](const Bolt& bolt) { return bolt.installed; }))
    throw std::invalid_argument("bolts and props do not follow movements of supports");
  if (block_held_in_part(model)) throw std::invalid_argument("supports hold a block in part");
  if (!is_loaded(model)) throw std::invalid_argument("no load acts");
  const MovementLaw movement_law(model, support, scene.system.settings().gravity_at(scene.end_time),
                                 search.direction);
  const PathLengths lengths(smallest_size(scene.system, model), scene.system.settings().contact_distance);
  const FollowedBlocks blocks(scene, lengths.reach);
  SupportMovement movement{support, movement_law.direction(), {}, {}};
  movement.away = !search.direction && movement_law.direction();
  movement.left_out_strength = std::any_of(
      model.points.begin(), model.points.end(),
      [](const RigidPoint& point) { return point.law.cohesion > 0.0 || point.law.tensile_strength > 0.0; });
  const auto least_towards = [&](double sign) {
    return least_path({blocks, movement_law, support, sign, lengths, scene.threads, std::nullopt}, search);
  };
  movement.out = least_towards(1.0);
  movement.in = least_towards(-1.0);
  return movement;
}

const char* to_string(MovementEnd end) {
  switch (end) {
    case MovementEnd::collapses:
      return "collapses";
    case MovementEnd::jams:
      return "jams";
    case MovementEnd::reaches_limit:
      return "reaches-limit";
    case MovementEnd::not_balanced:
      return "not-balanced";
    case MovementEnd::not_determined:
      return "not-determined";
    case MovementEnd::interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace ashlar

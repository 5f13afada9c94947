#include "solver/statics/followed_blocks.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/block/rigid_body.hpp"
#include "solver/state/automatic.hpp"
#include "solver/statics/yielding_support.hpp"

namespace ashlar {
namespace {

/// x -> A x + c of a block's coefficients.
Eigen::MatrixX3d mapped(const BlockModel& block, const Eigen::MatrixX3d& position, const Eigen::Matrix3d& a,
                        const Vector3& c) {
  const Eigen::VectorXd one = constant_function(position.rows(), block.basis().volume());
  return position * a.transpose() + one * c.transpose();
}

Eigen::Matrix3d turn_of(const Vector3& rotation) {
  const double angle = rotation.norm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, Vector3(rotation / angle)).toRotationMatrix();
}

/// Joints with friction only, in which faces meet as such up to the largest angle that the search has.
BlockSystem dry_system(const BlockSystem& system, double reach) {
  SimulationSettings settings = system.settings();
  settings.contact_distance = reach;
  settings.search.contact_angle = 0.25 * std::numbers::pi;
  std::vector<TieRequest> ties;
  for (const auto& [a, b] : system.left_out()) ties.push_back({a, b, 1.0});
  return BlockSystem(
      system.blocks(),
      [&system](int a, int b) {
        JointLaw law = system.law(a, b);
        law.cohesion = 0.0;
        law.tensile_strength = 0.0;
        return law;
      },
      settings, ties, system.absent());
}

}  // namespace

SupportWay::SupportWay(const RigidModel& model, int support, const Vector3& down,
                       const std::optional<Vector3>& direction)
    : support_(support), middle_(middle_of_bodies(model)), down_(down) {
  std::map<int, int> count;
  for (const RigidPoint& point : model.points) {
    if (point.blocks[0] != support && point.blocks[1] != support) continue;
    const int block = point.blocks[point.blocks[0] == support ? 1 : 0];
    arms_.try_emplace(block, Vector3::Zero()).first->second += level_part(point.place - middle_, down_);
    ++count[block];
  }
  if (arms_.empty()) throw std::invalid_argument("nothing bears on the support");
  double sum = 0.0;
  for (auto& [block, arm] : arms_) {
    arm /= count[block];
    sum += arm.norm();
  }
  direction_ = direction ? direction->normalized() : direction_away(model, support, down);
  // A block in the very middle of its support stays where it is.
  if (!direction_ && sum > 0.0) radius_ = sum / static_cast<double>(arms_.size());
}

Vector3 SupportWay::velocity(const RigidPoint& point, double q) const {
  if (direction_) return *direction_;
  const auto arm = arms_.find(point.blocks[point.blocks[0] == support_ ? 1 : 0]);
  if (arm != arms_.end()) return arm->second / radius_;
  return level_part(point.place - middle_, down_) / (radius_ + q);
}

Eigen::MatrixX3d SupportWay::placed(const BlockModel& support, const Eigen::MatrixX3d& position,
                                    double q) const {
  if (direction_) return mapped(support, position, Eigen::Matrix3d::Identity(), q * *direction_);
  Eigen::Matrix3d level;
  for (int k = 0; k < 3; ++k) level.col(k) = level_part(Vector3::Unit(k), down_);
  const Eigen::Matrix3d stretch = q / radius_ * level;
  return mapped(support, position, Eigen::Matrix3d::Identity() + stretch, -stretch * middle_);
}

FollowedBlocks::FollowedBlocks(const PlacedScene& scene, double reach)
    : scene_(scene), system_(dry_system(scene.system, reach)) {
  for (const BlockModel& block : system_.blocks()) {
    double radius = 0.0;
    for (const Vector3& point : block.solid().mesh().points)
      radius = std::max(radius, (point - block.basis().centroid()).norm());
    radius_.push_back(radius);
  }
}

Placement FollowedBlocks::as_placed() const {
  return {0.0,
          scene_.states,
          std::vector<Eigen::Matrix3d>(scene_.states.size(), Eigen::Matrix3d::Identity()),
          {}};
}

RigidModel FollowedBlocks::model_of(const Placement& placement) const {
  RunState state;
  state.states = placement.states;
  for (const auto& [blocks, history] : scene_.histories) state.pairs[blocks].overlap = history.overlap;
  return rigid_model(system_, state, scene_.end_time, {});
}

double FollowedBlocks::radius_about(const RigidBody& body) const {
  double radius = 0.0;
  for (const int block : body.blocks) {
    double own = radius_[at(block)];
    // Blocks that are tied to each other keep their distances.
    if (body.blocks.size() > 1) {
      Vector3 middle = Vector3::Zero();
      double mass = 0.0;
      for (const int k : body.blocks) {
        const BlockModel& model = system_.blocks()[at(k)];
        middle += model.mass() * model.basis().centroid();
        mass += model.mass();
      }
      own += (system_.blocks()[at(block)].basis().centroid() - middle / mass).norm();
    }
    radius = std::max(radius, own);
  }
  return radius;
}

double FollowedBlocks::largest_way(const RigidModel& model, const std::vector<BodyVelocity>& way) const {
  double largest = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const RigidMotionOf motion = motion_of(model.bodies[b], way[b]);
    largest =
        std::max(largest, motion.translation.norm() + radius_about(model.bodies[b]) * motion.rotation.norm());
  }
  return largest;
}

void FollowedBlocks::move(const RigidModel& model, const std::vector<BodyVelocity>& way,
                          Placement& placement) const {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const RigidBody& body = model.bodies[b];
    const RigidMotionOf motion = motion_of(body, way[b]);
    const Eigen::Matrix3d turn = turn_of(motion.rotation);
    for (const int k : body.blocks) {
      Eigen::MatrixX3d& position = placement.states[at(k)].position;
      position = mapped(system_.blocks()[at(k)], position, turn,
                        body.middle + motion.translation - turn * body.middle);
      placement.turn[at(k)] = turn * placement.turn[at(k)];
    }
  }
}

void FollowedBlocks::place_support(int support, const SupportWay& way, double q, Placement& placement) const {
  placement.states[at(support)].position =
      way.placed(system_.blocks()[at(support)], scene_.states[at(support)].position, q);
  placement.moved = q;
}

RigidModel midway(const RigidModel& model, const ConeProgram& program, const std::vector<BodyVelocity>& way) {
  RigidModel mid = model;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    mid.bodies[b].middle += 0.5 * motion_of(model.bodies[b], way[b]).translation;
  for (const ConePair& pair : program.pairs()) {
    const auto [a, b] = pair.bodies;
    Vector3 rotation = Vector3::Zero();  // mean of both sides
    for (const int body : pair.bodies)
      if (body >= 0 && at(body) < model.bodies.size())
        rotation += 0.5 * motion_of(model.bodies[at(body)], way[at(body)]).rotation;
    const Eigen::Matrix3d turn = turn_of(0.5 * rotation);
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const ConePoint& point = program.points()[k];
      Eigen::Vector3d both = Eigen::Vector3d::Zero();
      if (a >= 0) both += point.first * way[at(a)];
      if (b >= 0) both += point.second * way[at(b)];
      mid.points[k].place += 0.25 * model.points[k].frame.transpose() * both;
      mid.points[k].frame = model.points[k].frame * turn.transpose();
    }
  }
  return mid;
}

double smallest_size(const BlockSystem& system, const RigidModel& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const RigidBody& body : model.bodies)
    for (const int block : body.blocks) smallest = std::min(smallest, block_size(system.blocks()[at(block)]));
  return smallest;
}

}  // namespace ashlar

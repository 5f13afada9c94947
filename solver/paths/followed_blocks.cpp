#include "solver/paths/followed_blocks.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "geometry/exact/axis_rotation.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Of the fastest block: slower ones do not belong to the mechanism. Smaller values list blocks that move by rounding.
constexpr double mechanism_share = 0.01;
/// Squared motion over the gap of its programme: loads cannot be balanced. Smaller values mistake the error of a programme
/// for motion, larger ones leave more ends of paths undetermined.
constexpr double certain_motion_over_gap = 10.0;

/// Joints with friction only and face-face contact up to the largest angle of the search.
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
        if (law.residual) law.friction = law.residual->friction;
        return law;
      },
      settings, ties, system.absent());
}

}  // namespace

FollowedBlocks::FollowedBlocks(const PlacedScene& scene, double reach)
    : scene_(scene), system_(dry_system(scene.system, reach)) {
  for (const BlockModel& block : system_.blocks()) {
    double radius = 0.0;
    for (const Vector3& point : block.solid().mesh().points)
      radius = std::max(radius, (point - block.basis().centroid()).norm());
    radius_.push_back(radius);
  }
}

FollowedPlace FollowedBlocks::as_placed() const {
  return {0.0,
          scene_.states,
          std::vector<Eigen::Matrix3d>(scene_.states.size(), Eigen::Matrix3d::Identity()),
          {}};
}

RigidModel FollowedBlocks::model_of(const FollowedPlace& placement,
                                    const std::vector<bool>& multiplied) const {
  RunState state;
  state.states = placement.states;
  for (const auto& [blocks, history] : scene_.histories) state.pairs[blocks].overlap = history.overlap;
  return rigid_model(system_, state, scene_.end_time, multiplied);
}

double FollowedBlocks::radius_about(const RigidBody& body) const {
  double radius = 0.0;
  for (const int block : body.blocks) {
    double own = radius_[at(block)];
    // Tied blocks keep their distances.
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

double FollowedBlocks::travel_of(const RigidBody& body, const BodyVelocity& travel) const {
  const RigidMotionOf motion = motion_of(body, travel);
  return motion.translation.norm() + radius_about(body) * motion.rotation.norm();
}

double FollowedBlocks::largest_travel(const RigidModel& model,
                                      const std::vector<BodyVelocity>& travel) const {
  double largest = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    largest = std::max(largest, travel_of(model.bodies[b], travel[b]));
  return largest;
}

std::vector<int> FollowedBlocks::moving_blocks(const RigidModel& model,
                                               const std::vector<BodyVelocity>& velocity) const {
  const double largest = largest_travel(model, velocity);
  std::vector<int> moving;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (travel_of(model.bodies[b], velocity[b]) > mechanism_share * largest)
      moving.insert(moving.end(), model.bodies[b].blocks.begin(), model.bodies[b].blocks.end());
  std::sort(moving.begin(), moving.end());
  return moving;
}

void FollowedBlocks::move(const RigidModel& model, const std::vector<BodyVelocity>& travel,
                          FollowedPlace& placement) const {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const RigidBody& body = model.bodies[b];
    const RigidMotionOf motion = motion_of(body, travel[b]);
    const Eigen::Matrix3d turn = rotation_matrix(motion.rotation);
    for (const int k : body.blocks) {
      Eigen::MatrixX3d& position = placement.states[at(k)].position;
      position = mapped(system_.blocks()[at(k)], position, turn,
                        body.middle + motion.translation - turn * body.middle);
      placement.turn[at(k)] = turn * placement.turn[at(k)];
    }
  }
}

void FollowedBlocks::place_support(int support, const MovementLaw& movement_law, double q,
                                   FollowedPlace& placement) const {
  placement.states[at(support)].position =
      movement_law.placed(system_.blocks()[at(support)], scene_.states[at(support)].position, q);
  placement.moved = q;
}

RigidModel midway(const RigidModel& model, const ConeProgram& program,
                  const std::vector<BodyVelocity>& travel) {
  RigidModel mid = model;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    mid.bodies[b].middle += 0.5 * motion_of(model.bodies[b], travel[b]).translation;
  for (const ConePair& pair : program.pairs()) {
    const auto [a, b] = pair.bodies;
    Vector3 rotation = Vector3::Zero();  // mean of both sides
    for (const int body : pair.bodies)
      if (body >= 0 && at(body) < model.bodies.size())
        rotation += 0.5 * motion_of(model.bodies[at(body)], travel[at(body)]).rotation;
    const Eigen::Matrix3d turn = rotation_matrix(0.5 * rotation);
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const ConePoint& point = program.points()[k];
      Eigen::Vector3d both = Eigen::Vector3d::Zero();
      if (a >= 0) both += point.first * travel[at(a)];
      if (b >= 0) both += point.second * travel[at(b)];
      RigidPoint& moved = mid.points[k];
      moved.friction_place = turn * (moved.friction_place - moved.place);
      moved.place += 0.25 * model.points[k].frame.transpose() * both;
      moved.friction_place += moved.place;
      mid.points[k].frame = model.points[k].frame * turn.transpose();
    }
  }
  return mid;
}

std::vector<double> gaps_over(const RigidModel& model, double length) {
  std::vector<double> gaps;
  gaps.reserve(model.points.size());
  for (const RigidPoint& point : model.points)
    gaps.push_back(std::min(point.contact.gap / length, largest_shift));
  return gaps;
}

std::vector<BodyVelocity> times(double factor, std::vector<BodyVelocity> travel) {
  for (BodyVelocity& v : travel) v *= factor;
  return travel;
}

bool cannot_balance(ConeProgram& program, const std::vector<BodyVelocity>& load) {
  ConeQuestion question;
  question.load = load;
  const ConeAnswer answer = program.solve(question);
  double square = 0.0;
  for (const BodyVelocity& v : answer.velocity) square += v.squaredNorm();
  return answer.status == ConeStatus::solved && square > certain_motion_over_gap * answer.gap;
}

double smallest_size(const BlockSystem& system, const RigidModel& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const RigidBody& body : model.bodies)
    for (const int block : body.blocks) smallest = std::min(smallest, system.blocks()[at(block)].size());
  return smallest;
}

}  // namespace ashlar

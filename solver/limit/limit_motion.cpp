#include "solver/limit/limit_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

/// Relative to the fastest body: others move with it.
constexpr double moves_along = 1e-3;
/// Relative to the fastest body: a joint slides or opens.
constexpr double joint_moves = 0.05;
/// Relative to the largest load of a moving body: a joint transmits force.
constexpr double joint_bears = 1e-3;
/// Cosine of the angle of normals, 2.6 degrees, within which joints are one plane of a mode: with a larger cosine the
/// joints of a rough plane count as several, with a smaller one the planes of a flat wedge as one.
constexpr double one_plane = 0.999;
/// Motion of points by rotation, of the translation: a body with less does not topple.
constexpr double least_rotation = 0.1;

/// Sums and extremes over the points of a joint.
struct Joint {
  double normal = 0.0, slid = 0.0, opened = 0.0;
  Vector3 direction = Vector3::Zero();
};
using JointsByPair = std::map<PairKey, Joint>;

class Setting {
 public:
  Setting(const RigidModel& model, const ConeProgram& program, const LimitTrial& trial)
      : model_(model), program_(program), trial_(trial), together_(model.bodies.size()) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (speed(b) <= fastest_) continue;
      fastest_ = speed(b);
      leader_ = b;
    }
    for (std::size_t b = 0; b < model.bodies.size(); ++b) moves_.push_back(speed(b) > moves_along * fastest_);
  }

  [[nodiscard]] LimitMotion motion() {
    LimitMotion motion;
    motion.bars = bar_forces(model_, trial_.force);
    if (fastest_ == 0.0) return motion;
    note_blocks(motion);
    const JointsByPair joints = joints_seen();
    note_joints(joints, motion);
    motion.mode = mode(planes(joints, motion));
    return motion;
  }

 private:
  [[nodiscard]] double speed(std::size_t b) const {
    if (model_.bodies[b].blocks.empty()) return 0.0;
    return trial_.acceleration[b].norm() / std::sqrt(model_.bodies[b].mass / model_.units.mass);
  }

  void note_blocks(LimitMotion& motion) const {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      if (!moves_[b]) continue;
      const RigidMotionOf rigid =
          motion_of(model_.bodies[b], model_.units.acceleration * trial_.acceleration[b]);
      for (const int block : model_.bodies[b].blocks)
        motion.blocks.push_back({block, model_.bodies[b].middle, rigid.translation, rigid.rotation});
    }
    std::sort(motion.blocks.begin(), motion.blocks.end(),
              [](const LimitMotion::Block& x, const LimitMotion::Block& y) { return x.block < y.block; });
  }

  [[nodiscard]] JointsByPair joints_seen() const {
    JointsByPair seen;
    for (std::size_t n = 0; n < model_.pairs.size(); ++n) {
      const auto [a, b] = model_.pairs[n].bodies;
      if (!(a >= 0 && moves_[at(a)]) && !(b >= 0 && moves_[at(b)])) continue;
      for (std::size_t k = model_.pairs[n].begin; k < model_.pairs[n].end; ++k) {
        const RigidPoint& point = model_.points[k];
        if (point.bar) continue;
        const auto [first, second] = key_of(point.blocks);
        Joint& joint = seen[{first, second}];
        const Eigen::Vector3d y = program_.relative(n, k, trial_.acceleration);
        joint.normal += std::max(trial_.force[k][0], 0.0);
        joint.slid = std::max(joint.slid, y.tail<2>().norm());
        joint.opened = std::max(joint.opened, y[0]);
        joint.direction += point.frame.row(0).transpose();
      }
    }
    return seen;
  }

  /// Blocks with sticking joints move as one.
  void note_joints(const JointsByPair& joints, LimitMotion& motion) {
    double load = 0.0;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b)
      if (moves_[b])
        load = std::max(load, (model_.steady[b] + trial_.factors.load * model_.multiplied[b]).norm());
    for (const auto& [blocks, joint] : joints) {
      const bool bears = joint.normal > joint_bears * load;
      const bool slides = joint.slid > joint_moves * fastest_;
      const bool opens = !bears && (slides || joint.opened > joint_moves * fastest_);
      const JointMotion how = opens ? JointMotion::opens : slides ? JointMotion::slides : JointMotion::sticks;
      motion.joints.push_back({blocks, how});
      const int a = model_.body_of[at(blocks[0])], b = model_.body_of[at(blocks[1])];
      if (a >= 0 && b >= 0 && how == JointMotion::sticks) together_.unite(a, b);
    }
  }

  [[nodiscard]] bool leads(int block) {
    const int own = model_.body_of[at(block)];
    return own >= 0 && together_.find(own) == together_.find(static_cast<int>(leader_));
  }

  /// Directions of the planes on which the blocks moving with the fastest body slide.
  [[nodiscard]] std::size_t planes(const JointsByPair& joints, const LimitMotion& motion) {
    std::vector<Vector3> planes;
    for (const MovingJoint& joint : motion.joints) {
      if (joint.motion != JointMotion::slides || leads(joint.blocks[0]) == leads(joint.blocks[1])) continue;
      const Vector3 normal = joints.at(joint.blocks).direction.normalized();
      const bool listed = std::any_of(planes.begin(), planes.end(), [&](const Vector3& plane) {
        return std::abs(plane.dot(normal)) > one_plane;
      });
      if (!listed) planes.push_back(normal);
    }
    return planes.size();
  }

  /// True if points of the fastest body move by its rotation.
  [[nodiscard]] bool turns() const {
    const RigidBody& body = model_.bodies[leader_];
    const RigidMotionOf rigid = motion_of(body, trial_.acceleration[leader_]);
    double reach = 0.0;
    for (const ConePair& pair : model_.pairs) {
      const auto [a, b] = pair.bodies;
      if (a != static_cast<int>(leader_) && b != static_cast<int>(leader_)) continue;
      for (std::size_t k = pair.begin; k < pair.end; ++k)
        if (!model_.points[k].bar) reach = std::max(reach, (model_.points[k].place - body.middle).norm());
    }
    return rigid.rotation.norm() * reach > least_rotation * rigid.translation.norm();
  }

  [[nodiscard]] std::string mode(std::size_t planes) const {
    if (turns()) return planes == 0 ? "topples" : "topples and slides";
    if (planes == 0) return "falls";
    if (planes == 1) return "slides on one plane";
    return planes == 2 ? "slides along two planes" : "slides on several planes";
  }

  const RigidModel& model_;
  const ConeProgram& program_;
  const LimitTrial& trial_;
  double fastest_ = 0.0;
  std::size_t leader_ = 0;
  std::vector<bool> moves_;
  UnionFind together_;
};

}  // namespace

LimitMotion limit_motion(const RigidModel& model, const ConeProgram& program, const LimitTrial& trial) {
  return Setting(model, program, trial).motion();
}

const char* to_string(JointMotion motion) {
  switch (motion) {
    case JointMotion::sticks:
      return "sticks";
    case JointMotion::slides:
      return "slides";
    case JointMotion::opens:
      return "opens";
  }
  return "";
}

}  // namespace ashlar

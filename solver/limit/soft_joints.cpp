#include "solver/limit/soft_joints.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// Share of the load from which on it is told.
constexpr double worth_telling = 0.05;

/// Largest share of a motion in which blocks do not tip.
constexpr double no_turn = 0.1;

Vector3 turn_of(const LimitMotion& motion, int block) {
  for (const LimitMotion::Block& moving : motion.blocks)
    if (moving.block == block) return moving.angular_acceleration;
  return Vector3::Zero();
}

/// True if two blocks turn against each other. @param width m, of their joint
bool tips(const LimitMotion& motion, const PairKey& blocks, double width) {
  double fastest = 0.0;
  for (const LimitMotion::Block& moving : motion.blocks)
    fastest = std::max(fastest, moving.acceleration.norm());
  const Vector3 turn = turn_of(motion, blocks[0]) - turn_of(motion, blocks[1]);
  return turn.norm() * width > no_turn * fastest;
}

/// No share where blocks do not tip.
SoftJoint compliance_of(const PairRecord& record, const JointLaw& law, const LimitMotion& motion) {
  double force = 0.0, area = 0.0;
  for (std::size_t k = 0; k < record.points.size(); ++k) {
    force += std::max(record.responses[k].force[0], 0.0);
    area += record.points[k].area;
  }
  SoftJoint joint{{record.a, record.b}, 0.0, 0.0};
  if (!(force > 0.0 && area > 0.0) || !tips(motion, joint.blocks, std::sqrt(area))) return joint;
  joint.closure = law.normal_spring().closure(force / area);
  joint.share = correctly_rounded::cbrt(6.0 * joint.closure / std::sqrt(area));
  return joint;
}

}  // namespace

std::optional<SoftJoint> softest_joint(const std::vector<PairRecord>& rest, const LimitMotion& motion,
                                       const BlockSystem& system) {
  std::optional<SoftJoint> softest;
  for (const PairRecord& record : rest) {
    const JointLaw law = system.law(record.a, record.b);
    if (law.rigid || !law.area_springs) continue;
    const SoftJoint joint = compliance_of(record, law, motion);
    if (joint.share >= worth_telling && (!softest || joint.share > softest->share)) softest = joint;
  }
  return softest;
}

}  // namespace ashlar

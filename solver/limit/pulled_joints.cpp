#include "solver/limit/pulled_joints.hpp"

#include <map>

namespace ashlar {
namespace {

/// Relative to the forces and strengths of a joint: shear within rounding error.
constexpr double no_shear = 1e-6;

}  // namespace

PulledJoints::PulledJoints(const RigidModel& model) {
  std::map<BlockPair, int> joints;
  joint_of_.reserve(model.points.size());
  for (const RigidPoint& point : model.points) {
    const bool bonds = !point.bar && point.law.tensile_strength > 0.0;
    joint_of_.push_back(
        bonds ? joints.try_emplace(point.blocks, static_cast<int>(joints.size())).first->second : -1);
  }
  uses_.assign(joints.size(), JointUse::pressed);
}

bool PulledJoints::choose(const RigidModel& model, const std::vector<Eigen::Vector3d>& force,
                          const std::vector<double>& factors) {
  struct Resultant {
    Vector3 force = Vector3::Zero();
    double normal = 0.0, size = 0.0;
    double cohesion = 0.0, friction = 0.0;  ///< of the pulled joint
  };
  std::vector<Resultant> sums(uses_.size());
  for (std::size_t k = 0; k < joint_of_.size(); ++k) {
    if (joint_of_[k] < 0) continue;
    Resultant& sum = sums[static_cast<std::size_t>(joint_of_[k])];
    const ConeStrength pulled = strength_of(model, model.points[k], factors[k], JointUse::pulled);
    Vector3 along = model.points[k].frame.transpose() * force[k];
    along -= force[k][0] * model.points[k].frame.row(0).transpose();
    sum.force += along;
    sum.normal += force[k][0];
    sum.size += force[k].norm() + pulled.tension;
    sum.cohesion += pulled.cohesion;
    sum.friction = pulled.friction;
  }
  bool changed = false;
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const Resultant& sum = sums[n];
    const bool has_shear = sum.force.norm() <= sum.cohesion + sum.friction * sum.normal + no_shear * sum.size;
    const JointUse use = sum.normal < 0.0 || has_shear ? JointUse::pulled : JointUse::pressed;
    changed = changed || use != uses_[n];
    uses_[n] = use;
  }
  return changed;
}

}  // namespace ashlar

#include "solver/contact/tied_points.hpp"

#include <limits>

namespace ashlar {

Eigen::MatrixX3d tie_gap(const Tie& tie, const BlockState& a, const BlockState& b) {
  return tie.a * a.position - tie.b * b.position;
}

std::vector<ContactPoint> tie_points(const Eigen::MatrixX3d& gap) {
  std::vector<ContactPoint> points(static_cast<std::size_t>(gap.rows()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    ContactPoint& point = points[k];
    point.type = ContactPointType::face_face;
    point.normal = Vector3::UnitX();
    point.tangent_1 = Vector3::UnitY();
    point.tangent_2 = Vector3::UnitZ();
    point.place_a = gap.row(static_cast<Eigen::Index>(k));
    point.place_b.setZero();
    point.gap = point.place_a.x();
    point.area = 1.0;
  }
  return points;
}

std::vector<PointMemory> tie_memory(const Eigen::MatrixX3d& gap) {
  std::vector<PointMemory> memory(static_cast<std::size_t>(gap.rows()));
  for (std::size_t k = 0; k < memory.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    memory[k].slip = {0.0, gap(row, 1), gap(row, 2)};
    memory[k].state = ContactState::locked;
    memory[k].intact = true;
  }
  return memory;
}

JointLaw unbreakable_law(double stiffness) {
  JointLaw law;
  law.normal_stiffness = law.shear_stiffness = stiffness;
  // Far above any force, with finite differences.
  law.cohesion = 1e100;
  law.tensile_strength = std::numeric_limits<double>::infinity();
  return law;
}

}  // namespace ashlar

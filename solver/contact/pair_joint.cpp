// The part of ContactPair about joint properties beside springs and friction: failure of strength and damping
// (mechanics/notes/joint_damping.md).
#include <algorithm>
#include <cmath>

#include "solver/contact/contact_pair.hpp"
#include "solver/contact/tied_points.hpp"

namespace ashlar {

bool ContactPair::bonded() const {
  return !tied() &&
         std::any_of(laws_.begin(), laws_.end(), [](const PointLaw& law) { return law.weakens(); });
}

void ContactPair::freeze_failure() {
  kind_.freezes_failure = true;
  const JointLaw bond = unbreakable_law(1.0);
  for (PointLaw& law : laws_) {
    // Strength that falls gradually is lost as far as the balance needs.
    if (tied() || law.bond.softens() || !law.weakens() || (law.cohesion == 0.0 && law.tension == 0.0))
      continue;
    law.cohesion = bond.cohesion;
    if (law.tension > 0.0) law.tension = bond.tensile_strength;
  }
  respond_at_start();
}

BondedArea ContactPair::bonded_area(const std::vector<PointMemory>& memory) const {
  BondedArea area;
  for (std::size_t k = 0; !tied() && k < memory.size(); ++k) {
    if (!memory_[k].intact || !laws_[k].weakens()) continue;
    (memory[k].intact ? area.left : area.lost) += points_[k].area;
  }
  return area;
}

bool ContactPair::fails(const std::vector<PointMemory>& memory) const {
  for (std::size_t k = 0; k < memory.size(); ++k) {
    if (memory_[k].intact && !memory[k].intact && laws_[k].weakens()) return true;
  }
  return false;
}

void ContactPair::damp(double step) {
  if (kind_.damping == 0.0 || reduced_mass_ == 0.0) return;
  double normal = 0.0;
  double shear = 0.0;
  for (const PointLaw& law : laws_) {
    normal += law.normal_stiffness;
    shear += law.shear_stiffness;
  }
  // c = k tau, with the same retardation time for all points: c = 2 zeta sqrt(k m) of all together.
  const auto retardation = [&](double stiffness) {
    return stiffness > 0.0 ? 2.0 * kind_.damping * std::sqrt(reduced_mass_ / stiffness) : 0.0;
  };
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    PointLaw& law = laws_[k];
    const auto start = start_.col(static_cast<Eigen::Index>(k));
    const Eigen::Vector2d slip = start.tail<2>();
    law.dashpots = {law.normal_stiffness * retardation(normal) / step,
                    law.shear_stiffness * retardation(shear) / step, start[0],
                    elastic_slip(law, start_responses_[k], slip)};
  }
}

double ContactPair::fracture_work(const PairResponse& response) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < response.points.size(); ++k)
    sum += response.points[k].fractured - start_responses_[k].fractured;
  return sum;
}

double ContactPair::damped(const PairResponse& response) {
  double sum = 0.0;
  for (const PointResponse& point : response.points) sum += point.damped;
  return sum;
}

}  // namespace ashlar

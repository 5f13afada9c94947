// Bonds of a contact pair: what of its points has strength to lose.
#include <algorithm>

#include "solver/contact/contact_pair.hpp"
#include "solver/contact/tied_points.hpp"

namespace ashlar {

bool ContactPair::bonded() const {
  return !tied() &&
         std::any_of(laws_.begin(), laws_.end(), [](const PointLaw& law) { return law.weakens(); });
}

void ContactPair::hold_bonds() {
  kind_.holds_bonds = true;
  const JointLaw bond = unbreakable_law(1.0);
  for (PointLaw& law : laws_) {
    if (tied() || !law.weakens() || (law.cohesion == 0.0 && law.tension == 0.0)) continue;
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

}  // namespace ashlar

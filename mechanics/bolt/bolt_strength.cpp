#include "mechanics/bolt/bolt_strength.hpp"

#include <cmath>

namespace ashlar {

BoltStrength bolt_strength(const BoltLaw& law) {
  if (is_brittle(law)) return {};
  BoltStrength strength;
  const bool grouted = law.anchorage == BoltAnchorage::grouted;
  strength.tension = law.tension ? law.yield_force : 0.0;
  strength.compression = law.compression && !grouted ? law.yield_force : 0.0;
  strength.bond = grouted ? law.bond_strength : BoltLaw::unlimited;
  strength.shear = grouted && law.shear_stiffness > 0.0 ? law.shear_strength : 0.0;
  return strength;
}

bool is_brittle(const BoltLaw& law) {
  return ductility(law) <= 1.0;
}

bool is_unlimited(const BoltLaw& law) {
  const BoltStrength strength = bolt_strength(law);
  const bool axial = std::isinf(strength.tension) || std::isinf(strength.compression);
  return (axial && std::isinf(strength.bond)) || std::isinf(strength.shear);
}

double ductility(const BoltLaw& law) {
  if (law.rupture_strain == BoltLaw::unlimited) return BoltLaw::unlimited;
  return law.rupture_strain * law.axial_stiffness / law.yield_force;
}

}  // namespace ashlar

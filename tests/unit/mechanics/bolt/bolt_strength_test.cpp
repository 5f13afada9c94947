// Strength of bolts in the plastic limit.
#include "mechanics/bolt/bolt_strength.hpp"

#include <gtest/gtest.h>

namespace ashlar::bolt_strength_test {
namespace {

BoltLaw grouted_law() {
  BoltLaw law;
  law.axial_stiffness = 1e8;
  law.yield_force = 2e5;
  law.bond_stiffness = 1e9;
  law.bond_strength = 3e5;
  return law;
}

TEST(BoltStrength, OfAGroutedBarIsTensionBondAndDowel) {
  BoltLaw law = grouted_law();
  EXPECT_EQ(bolt_strength(law).tension, 2e5);
  EXPECT_EQ(bolt_strength(law).compression, 0.0);
  EXPECT_EQ(bolt_strength(law).bond, 3e5);
  EXPECT_EQ(bolt_strength(law).shear, 0.0);
  law.shear_strength = 4e4;
  EXPECT_EQ(bolt_strength(law).shear, 0.0) << "without stiffness there is no dowel";
  law.shear_stiffness = 1e7;
  EXPECT_EQ(bolt_strength(law).shear, 4e4);
  EXPECT_FALSE(is_unlimited(law));
}

TEST(BoltStrength, OfPropsAndCablesHasTheirSigns) {
  BoltLaw prop;
  prop.anchorage = BoltAnchorage::ends;
  prop.axial_stiffness = 1e8;
  prop.yield_force = 5e4;
  prop.tension = false;
  EXPECT_EQ(bolt_strength(prop).tension, 0.0);
  EXPECT_EQ(bolt_strength(prop).compression, 5e4);
  prop.tension = true;
  EXPECT_EQ(bolt_strength(prop).tension, 5e4);
  prop.compression = false;
  EXPECT_EQ(bolt_strength(prop).compression, 0.0);
}

TEST(BoltStrength, PretensionChangesNothing) {
  BoltLaw law = grouted_law();
  law.pretension = 1e5;
  EXPECT_EQ(bolt_strength(law).tension, 2e5);
}

TEST(BoltStrength, ABarThatBreaksBeforeItYieldsHasNone) {
  // It yields at a strain of 2e5 / 1e8 = 0.002.
  BoltLaw law = grouted_law();
  law.rupture_strain = 0.001;
  EXPECT_TRUE(is_brittle(law));
  EXPECT_TRUE(bolt_strength(law).none());
  law.rupture_strain = 0.05;
  EXPECT_FALSE(is_brittle(law));
  EXPECT_DOUBLE_EQ(ductility(law), 25.0);
  EXPECT_EQ(bolt_strength(law).tension, 2e5);
  law.yield_force = BoltLaw::unlimited;
  EXPECT_TRUE(is_brittle(law)) << "it never yields";
}

TEST(BoltStrength, IsUnlimitedWithoutAStrengthThatEndsIt) {
  BoltLaw law = grouted_law();
  law.yield_force = BoltLaw::unlimited;
  EXPECT_FALSE(is_unlimited(law)) << "its bond slips";
  law.bond_strength = BoltLaw::unlimited;
  EXPECT_TRUE(is_unlimited(law));
  law.yield_force = 1e5;
  EXPECT_FALSE(is_unlimited(law));
  law.shear_stiffness = 1e7;
  EXPECT_TRUE(is_unlimited(law)) << "its dowels";
}

}  // namespace
}  // namespace ashlar::bolt_strength_test

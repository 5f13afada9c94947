// Joints whose tensile strength yields hold their area times their strength, by hand.
#include <gtest/gtest.h>

#include <string>

#include "sample_statics.hpp"

namespace ashlar::plastic_tension_test {
namespace {

using test_support::block_of;
using test_support::fixed_block;
using test_support::models;
using test_support::run_static;
using test_support::same_law;

constexpr double tension = 1e5;  ///< T, Pa
constexpr double density = 2500.0, gravity = 9.81;

JointLaw tough(double residual) {
  JointLaw law{2e11, 1e11, 0.7, 1e6, tension, true};
  law.residual = ResidualStrength{0.7, 1e6, residual};
  return law;
}

/// A cube of 1 m that hangs below a roof with a share of T A. Its joint keeps its face from contracting.
StaticStatus hang(double share, double poisson_ratio, int order, const JointLaw& law, bool augmented = false,
                  const Eigen::AngleAxisd& turn = Eigen::AngleAxisd::Identity()) {
  const Material stone{density, 1e10, poisson_ratio};
  const auto solid = [&](const Vector3& from, const Vector3& to) {
    return test_support::turned(Polyhedron(make_box(from, to)), turn);
  };
  BlockDefinition cube = block_of("cube", solid({-0.5, -0.5, 0}, {0.5, 0.5, 1}), stone, order);
  cube.loads.push_back({Plane{Vector3::Zero(), turn * Vector3::UnitZ()},
                        false,
                        turn * Vector3(0, 0, -(share * tension - density * gravity)),
                        {}});
  SimulationSettings settings;
  settings.gravity = turn * Vector3(0, 0, -gravity);
  settings.contact_distance = 1e-3;
  settings.augmented = augmented;
  Simulation simulation(models(std::move(cube), fixed_block(solid({-2, -2, 1}, {2, 2, 2}))), {{}, {}},
                        same_law(law), settings);
  return run_static(simulation, 1.0);
}

TEST(PlasticTension, HoldsItsAreaTimesItsStrengthForAnyPoissonRatio) {
  for (const double poisson_ratio : {0.0, 0.2, 0.3}) {
    for (const int order : {0, 1, 2}) {
      const std::string what = std::to_string(poisson_ratio) + " " + std::to_string(order);
      for (const double share : {0.65, 0.9, 0.99})
        EXPECT_EQ(hang(share, poisson_ratio, order, tough(tension)), StaticStatus::equilibrium)
            << what << " " << share;
      EXPECT_EQ(hang(1.01, poisson_ratio, order, tough(tension)), StaticStatus::moving) << what;
    }
  }
}

TEST(PlasticTension, HoldsInAnyDirection) {
  for (const Eigen::AngleAxisd& turn : {Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()),
                                        Eigen::AngleAxisd(2.5, Vector3(-1, 0.2, 0.7).normalized())}) {
    EXPECT_EQ(hang(0.98, 0.3, 2, tough(tension), false, turn), StaticStatus::equilibrium);
    EXPECT_EQ(hang(1.02, 0.3, 2, tough(tension), false, turn), StaticStatus::moving);
  }
}

TEST(PlasticTension, HoldsWithMultipliers) {
  EXPECT_EQ(hang(0.98, 0.3, 1, tough(tension), true), StaticStatus::equilibrium);
  EXPECT_EQ(hang(1.02, 0.3, 1, tough(tension), true), StaticStatus::moving);
}

TEST(PlasticTension, ABrokenJointYieldsAtItsResidualStrength) {
  // At a stress that is uniform the joint breaks at T, and half of that remains: beyond T it cannot hold. A corner that
  // breaks first leaves T/2 there, so that loads below T/2 always stand.
  EXPECT_EQ(hang(0.49, 0.3, 2, tough(0.5 * tension)), StaticStatus::equilibrium);
  EXPECT_EQ(hang(0.98, 0.0, 1, tough(0.5 * tension)), StaticStatus::equilibrium);
  EXPECT_EQ(hang(1.02, 0.0, 1, tough(0.5 * tension)), StaticStatus::moving);
}

}  // namespace
}  // namespace ashlar::plastic_tension_test

#include "solver/paths/spring_step.hpp"

#include <gtest/gtest.h>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::spring_step_test {
namespace {

using test_support::g;

/// A body on one point that it meets at its centre of gravity, of unit mass, free to translate along three axes: the
/// normal and two tangents.
class OnePoint {
 public:
  explicit OnePoint(const ConeStrength& strength, double dilation = 0.0)
      : program_({3}, {{{0, -1}, 0, 1}}, {point_of(strength)}, 1),
        step_(program_, {{stiffness, shear_stiffness, dilation}}) {}

  static constexpr double stiffness = 100.0, shear_stiffness = 40.0, inertia = 1e-4;

  [[nodiscard]] SpringSolution under(double normal, double shear, double before = 0.0) {
    BodyVelocity load = BodyVelocity::Zero();
    load.head<3>() = Eigen::Vector3d(-normal, shear, 0.0);
    return step_.solve({Eigen::Vector3d(before, 0.0, 0.0)}, {load}, inertia);
  }

 private:
  static ConePoint point_of(const ConeStrength& strength) {
    ConePoint point;
    point.first.leftCols<3>() = Eigen::Matrix3d::Identity();
    point.strength = strength;
    return point;
  }

  ConeProgram program_;
  SpringStep step_;
};

TEST(SpringStep, SticksWithTheStiffnessOfItsSprings) {
  OnePoint one({0.5});
  const SpringSolution found = one.under(2.0, 0.6);
  ASSERT_TRUE(found.converged);
  EXPECT_EQ(found.states[0], SpringState::sticks);
  EXPECT_NEAR(found.force[0][0], 2.0, 1e-5);
  EXPECT_NEAR(found.force[0][1], -0.6, 1e-5);
  EXPECT_NEAR(found.moved[0][0], -2.0 / OnePoint::stiffness, 1e-7);
  EXPECT_NEAR(found.moved[0][1], 0.6 / OnePoint::shear_stiffness, 1e-7);
}

TEST(SpringStep, SlidesAtItsFrictionLimitAgainstInertia) {
  OnePoint one({0.5});
  const SpringSolution found = one.under(2.0, 1.5);
  ASSERT_TRUE(found.converged);
  EXPECT_EQ(found.states[0], SpringState::slides);
  // F - mu N = m u
  EXPECT_NEAR(found.moved[0][1], (1.5 - 1.0) / OnePoint::inertia, 1.0);
  // Sliding does not open the joint.
  EXPECT_NEAR(found.moved[0][0], -2.0 / OnePoint::stiffness, 1e-6);
}

TEST(SpringStep, StartsFromEarlierForces) {
  OnePoint one({0.5});
  const SpringSolution found = one.under(2.0, 0.0, 2.0);
  ASSERT_TRUE(found.converged);
  EXPECT_EQ(found.iterations, 0);
  EXPECT_NEAR(found.moved[0].norm(), 0.0, 1e-12);
}

TEST(SpringStep, OpensUnderTension) {
  OnePoint one({0.5});
  const SpringSolution found = one.under(-1.0, 0.0);
  ASSERT_TRUE(found.converged);
  EXPECT_EQ(found.states[0], SpringState::open);
  EXPECT_NEAR(found.moved[0][0], 1.0 / OnePoint::inertia, 1.0);
}

TEST(SpringStep, HoldsTensionAndCohesionUpToTheirStrength) {
  ConeStrength strength{0.5, 1.0, 3.0};
  strength.keeps_cohesion = true;
  OnePoint one(strength);
  const SpringSolution pulled = one.under(-2.5, 0.9);
  ASSERT_TRUE(pulled.converged);
  EXPECT_EQ(pulled.states[0], SpringState::sticks);
  const SpringSolution torn = one.under(-3.5, 0.0);
  ASSERT_TRUE(torn.converged);
  EXPECT_NEAR(torn.force[0][0], -3.0, 1e-9);
}

TEST(SpringStep, CrushesAtItsCompressiveStrength) {
  ConeStrength strength{0.5};
  strength.compression = 2.0;
  OnePoint one(strength);
  const SpringSolution found = one.under(2.5, 0.0);
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.force[0][0], 2.0, 1e-9);
  EXPECT_NEAR(found.moved[0][0], -0.5 / OnePoint::inertia, 1.0);
}

TEST(SpringStep, RisesByItsDilation) {
  // Held from rising, the joint would gain normal force; free to rise, it opens by tan(psi) times its slip.
  OnePoint one({0.5}, 0.1);
  const SpringSolution found = one.under(2.0, 1.5);
  ASSERT_TRUE(found.converged);
  EXPECT_EQ(found.states[0], SpringState::slides);
  const double slip = found.moved[0][1], raised = found.moved[0][0] + 2.0 / OnePoint::stiffness;
  EXPECT_GT(slip, 1.0);
  EXPECT_NEAR(raised / slip, 0.1, 1e-3);
}

}  // namespace
}  // namespace ashlar::spring_step_test

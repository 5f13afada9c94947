#include "mechanics/contact/laws/rough_joint.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mechanics/contact/laws/joint_law.hpp"
#include "support/check_derivatives.hpp"

namespace ashlar::rough_joint_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double area = 0.1;

/// JRC 10, JCS 50 MPa, 30 degrees. kn = 2e9 N/m, ks = 1e9 N/m.
JointLaw rough_law() {
  JointLaw law{2e10, 1e10, std::tan(30.0 * degree)};
  law.roughness = {10.0, 5e7, law.friction};
  return law;
}

double strength_at(double pressure) {
  return rough_bound(point_roughness(rough_law().roughness, area, 0.0), pressure * area).value / area;
}

TEST(RoughJoint, StrengthIsThatOfBartonAndChoubey) {
  // 30 + 10 log10(JCS / sigma): 50, 40, 30 degrees at two, one, no decades below JCS; 70 degrees from four decades on.
  EXPECT_NEAR(strength_at(5e5) / 5e5, std::tan(50.0 * degree), 1e-12);
  EXPECT_NEAR(strength_at(5e6) / 5e6, std::tan(40.0 * degree), 1e-12);
  EXPECT_NEAR(strength_at(5e7) / 5e7, std::tan(30.0 * degree), 1e-12);
  EXPECT_NEAR(strength_at(5e3) / 5e3, std::tan(70.0 * degree), 1e-12);
  EXPECT_NEAR(strength_at(50.0) / 50.0, std::tan(70.0 * degree), 1e-12);
  EXPECT_EQ(strength_at(0.0), 0.0);
  // Beyond JCS along the tangent there: tan(30) - 10 (pi/180)/ln(10) (1 + tan(30)^2).
  const double slope = std::tan(30.0 * degree) - 10.0 * degree / std::numbers::ln10 * (4.0 / 3.0);
  EXPECT_NEAR((strength_at(7e7) - strength_at(5e7)) / 2e7, slope, 1e-12);
}

TEST(RoughJoint, StrengthIsConcaveAndItsSlopeIsItsDerivative) {
  const PointRoughness rough = point_roughness(rough_law().roughness, area, 0.0);
  double last = std::numeric_limits<double>::infinity();
  for (double pressure = 1e2; pressure < 1e9; pressure *= 1.3) {
    const double normal = pressure * area, step = 1e-6 * normal;
    const ShearBound bound = rough_bound(rough, normal);
    const double slope =
        (rough_bound(rough, normal + step).value - rough_bound(rough, normal - step).value) / (2.0 * step);
    EXPECT_NEAR(bound.slope, slope, 1e-6) << pressure;
    EXPECT_LE(bound.slope, last + 1e-12) << pressure;
    EXPECT_GT(bound.slope, 0.0);
    last = bound.slope;
  }
}

TEST(RoughJoint, FactorsDivideTheStrength) {
  Roughness roughness = rough_law().roughness;
  roughness.share = 0.5;
  EXPECT_NEAR(rough_bound(point_roughness(roughness, area, 0.0), 5e5 * area).value / area,
              0.5 * strength_at(5e5), 1e-9);
}

TEST(RoughJoint, RoughnessWearsWithSlip) {
  // A wall of 1 m: (1/500) 10^0.33 m.
  EXPECT_NEAR(peak_slip_of(10.0, 1.0), 0.002 * std::pow(10.0, 0.33), 1e-15);
  const std::array<std::array<double, 2>, 8> table = {{{0.0, 1.0},
                                                       {1.0, 1.0},
                                                       {2.0, 0.85},
                                                       {4.0, 0.7},
                                                       {10.0, 0.5},
                                                       {25.0, 0.4},
                                                       {100.0, 0.0},
                                                       {std::sqrt(8.0), 0.775}}};
  for (const auto& [slip, left] : table) EXPECT_NEAR(roughness_left(slip / 100.0), left, 1e-12) << slip;
  Roughness roughness = rough_law().roughness;
  EXPECT_FALSE(point_roughness(roughness, area, 0.25).wears());
  roughness.peak_slip = 2e-3;
  const PointRoughness rough = point_roughness(roughness, area, 0.25);
  EXPECT_NEAR(wear_after(rough, 0.25, 0.01), 0.3, 1e-15);
  EXPECT_EQ(wear_after(rough, 0.25, 1.0), 1.0);
  // A worn joint has Coulomb's friction, and remembers its wear, also at points without area.
  for (const PointRoughness& worn :
       {point_roughness(roughness, area, 1.0), point_roughness(roughness, 0.0, 0.5)}) {
    EXPECT_FALSE(worn.given());
    EXPECT_EQ(wear_after(worn, 0.5, 0.0), 0.5);
  }
}

TEST(RoughJoint, SlidingForceIsTheStrengthAndItsSlipIsCounted) {
  const PointLaw point = point_law(rough_law(), area, true);
  const double gap = -2.5e-5;  // 50 kN, 500 kPa
  const PointResponse response = point_response(point, gap, {3e-3, 0.0});
  const double force = 5e4 * std::tan(50.0 * degree);
  EXPECT_EQ(response.state, ContactState::sliding);
  EXPECT_NEAR(response.force[1], -force, 1e-8);
  EXPECT_NEAR(response.slid, 3e-3 - force / 1e9, 1e-15);
  const PointResponse start = point_response(point, gap, {0, 0});
  const AveragedStep step = averaged_step(point, start, {gap, 0, 0}, {gap, 3e-3, 0});
  EXPECT_NEAR(step.mean.force[1], -force, 1e-8);
  // The mean force is that of the spring at the middle of the step: it ends at 2 F/ks.
  EXPECT_NEAR(step.end.slid, 3e-3 - 2.0 * force / 1e9, 1e-15);
  // Dissipated: the work of friction less the energy of the spring.
  EXPECT_NEAR(force * 3e-3 - step.end.shear_energy, force * step.end.slid, 1e-9);
}

TEST(RoughJoint, DamageAfterAStepIsItsWear) {
  JointLaw law = rough_law();
  PointResponse response{};
  response.slid = 0.01;
  EXPECT_EQ(damage_after(point_law(law, area, true), point_law(law, area, true), response, 0.25), 0.0);
  law.roughness.peak_slip = 2e-3;
  const PointLaw point = point_law(law, area, true, 0.25);
  EXPECT_NEAR(damage_after(point, point, response, 0.25), 0.3, 1e-15);
}

TEST(RoughJoint, ItsFrictionVariesWithPressure) {
  JointLaw law = rough_law();
  EXPECT_TRUE(law.friction_varies());
  EXPECT_NEAR(point_law(law, area, true).friction_at(5e5 * area), strength_at(5e5) / 5e5, 1e-12);
  EXPECT_EQ(point_law(law, area, true).friction_at(0.0), law.friction);
  EXPECT_NEAR(friction_of_part(law, area, 5e5 * area), strength_at(5e5) * area, 1e-6);
  law.roughness.share = 0.5;
  EXPECT_NEAR(least_friction(law, 3.0), 1.5 * std::tan(30.0 * degree), 1e-15);
}

TEST(RoughJoint, AMeanCoefficientIsThatOfResidualStrengthIfNothingWears) {
  JointLaw law = rough_law();
  law.residual = ResidualStrength{law.friction, 0.0, 0.0};
  set_mean_friction(law, 0.9);
  EXPECT_EQ(law.friction, 0.9);
  EXPECT_EQ(law.residual->friction, 0.9);
  EXPECT_TRUE(failed_law(law).roughness.given());
  law = rough_law();
  law.residual = ResidualStrength{law.friction, 0.0, 0.0};
  law.roughness.peak_slip = 2e-3;
  set_mean_friction(law, 0.9);
  EXPECT_EQ(law.residual->friction, std::tan(30.0 * degree));
  const JointLaw worn = failed_law(law);
  EXPECT_FALSE(worn.friction_varies());
  EXPECT_EQ(worn.friction, std::tan(30.0 * degree));
}

TEST(RoughJoint, TangentsAreDerivatives) {
  const PointLaw point = point_law(rough_law(), area, true);
  for (const double gap : {-1e-9, -1e-6, -1.2e-5, -2e-3}) {
    const Eigen::Vector3d place(gap, 2e-2, 0.7e-2);
    const PointResponse end = point_response(point, gap, place.tail<2>());
    const auto force = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
      return -point_response(point, at[0], at.tail<2>()).force;
    };
    test_support::expect_derivative(force, place,
                                    end.tangent + end.coupling.force * end.coupling.by.transpose(),
                                    1e-4 * std::abs(gap), 1e-4);
  }
}

TEST(RoughJoint, PointsWithoutAreaHaveTheFrictionOfTheWornJoint) {
  const PointLaw point = point_law(rough_law(), 0.0, true);
  EXPECT_FALSE(point.roughness.given());
  EXPECT_EQ(point.friction, std::tan(30.0 * degree));
}

}  // namespace
}  // namespace ashlar::rough_joint_test

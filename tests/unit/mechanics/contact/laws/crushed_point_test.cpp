#include "mechanics/contact/laws/crushed_point.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/check_derivatives.hpp"

namespace ashlar::crushed_point_test {
namespace {

// kn = 2e8 N/m, ks = 1e8 N/m, f A = 4000 N at a gap of -2e-5 m, which holds 0.04 J.
constexpr double area = 0.1;
constexpr double elastic_gap = -2e-5;

PointLaw weak_point() {
  JointLaw law{2e9, 1e9, 0.5};
  law.compressive_strength = 4e4;
  return point_law(law, area, true);
}

TEST(CrushedPoint, ForceStopsAtTheStrengthAndClosureRemains) {
  const PointLaw point = weak_point();
  const PointResponse elastic = point_response(point, -1.5e-5, {0, 0});
  EXPECT_NEAR(elastic.force[0], 3000.0, 1e-9);
  EXPECT_EQ(elastic.dilation, 0.0);
  const PointResponse crushed = point_response(point, -5e-5, {0, 0});
  EXPECT_EQ(crushed.force[0], 4000.0);
  EXPECT_NEAR(crushed.dilation, -3e-5, 1e-18);
  EXPECT_EQ(crushed.tangent(0, 0), 0.0);
  EXPECT_NEAR(crushed.normal_energy, 0.04, 1e-15);
  EXPECT_NEAR(crushed.fractured, 4000.0 * 3e-5, 1e-15);
}

TEST(CrushedPoint, FrictionIsThatUnderTheStrength) {
  const PointResponse sliding = point_response(weak_point(), -5e-5, {1e-3, 0});
  EXPECT_EQ(sliding.state, ContactState::sliding);
  EXPECT_NEAR(sliding.force[1], -2000.0, 1e-9);
  EXPECT_NEAR(sliding.shear_energy, 0.5 * 2000.0 * 2000.0 / 1e8, 1e-15);
}

TEST(CrushedPoint, PointsWithoutAreaDoNotCrush) {
  JointLaw law{2e9, 1e9, 0.5};
  law.area_springs = false;
  law.compressive_strength = 4e4;
  EXPECT_NEAR(point_response(point_law(law, 0.0, true), -1e-3, {0, 0}).force[0], 2e6, 1e-6);
}

/// The work of the mean force over a step and what becomes of it.
void expect_exact_work(double start_gap, double end_gap) {
  const PointLaw point = weak_point();
  const PointResponse start = point_response(point, start_gap, {0, 0});
  const AveragedStep step = averaged_step(point, start, {start_gap, 0, 0}, {end_gap, 0, 0});
  const double work = step.mean.force[0] * (start_gap - end_gap);
  const double gained = step.end.normal_energy - start.normal_energy;
  EXPECT_NEAR(work, gained + step.end.fractured - start.fractured, 1e-15) << start_gap << " to " << end_gap;
}

TEST(CrushedPoint, WorkOfAStepIsThatOfTheSpringAndOfCrushing) {
  for (const auto& [start, end] : std::array<std::array<double, 2>, 7>{{{1e-5, -5e-5},
                                                                        {-1e-5, -5e-5},
                                                                        {elastic_gap, -3e-5},
                                                                        {-5e-5, -7e-5},
                                                                        {-5e-5, -4e-5},
                                                                        {-5e-5, 2e-5},
                                                                        {1e-5, -1e-5}}})
    expect_exact_work(start, end);
}

TEST(CrushedPoint, ClosureOfTheStartIsKept) {
  const PointLaw point = weak_point();
  const PointResponse start = point_response(point, -5e-5, {0, 0});
  const AveragedStep back = averaged_step(point, start, {-5e-5, 0, 0}, {-4e-5, 0, 0});
  EXPECT_NEAR(back.end.dilation, -3e-5, 1e-18);
  EXPECT_NEAR(back.end.force[0], 2000.0, 1e-9);
  EXPECT_NEAR(back.mean.force[0], 3000.0, 1e-9);
}

TEST(CrushedPoint, ABondThatPartsGivesTheEnergyOfItsSpringLessThatOfItsStrength) {
  JointLaw law{2e9, 1e9, 0.5, 0.0, 2e4};
  law.compressive_strength = 4e4;
  const PointLaw point = point_law(law, area, true);
  const PointResponse start = point_response(point, -5e-5, {0, 0});
  const AveragedStep step = averaged_step(point, start, {-5e-5, 0, 0}, {1e-3, 0, 0});
  EXPECT_EQ(step.end.state, ContactState::open);
  // 0.04 J, less (2000 N)^2/(2 kn) = 0.01 J, over the way.
  EXPECT_NEAR(step.mean.force[0] * 1.05e-3, 0.04 - 0.01, 1e-15);
}

TEST(CrushedPoint, TangentsAreDerivatives) {
  const PointLaw point = weak_point();
  for (const double gap : {-1.2e-5, -3.1e-5, -4.7e-5}) {
    const PointResponse end = point_response(point, gap, {1e-5, 0.7e-5});
    const auto force = [&](const Eigen::VectorXd& place) -> Eigen::VectorXd {
      return -point_response(point, place[0], place.tail<2>()).force;
    };
    test_support::expect_derivative(force, Eigen::Vector3d(gap, 1e-5, 0.7e-5),
                                    end.tangent + end.coupling.force * end.coupling.by.transpose(), 1e-9,
                                    1e-6);
    const PointResponse start = point_response(point, -0.4e-5, {0, 0});
    const auto averaged = [&](const Eigen::VectorXd& place) -> Eigen::VectorXd {
      return -averaged_step(point, start, {-0.4e-5, 0, 0}, place).mean.force;
    };
    const MeanResponse mean = averaged_step(point, start, {-0.4e-5, 0, 0}, {gap, 1e-5, 0.7e-5}).mean;
    test_support::expect_derivative(averaged, Eigen::Vector3d(gap, 1e-5, 0.7e-5),
                                    mean.tangent + mean.coupling.force * mean.coupling.by.transpose(), 1e-9,
                                    1e-6);
  }
}

}  // namespace
}  // namespace ashlar::crushed_point_test

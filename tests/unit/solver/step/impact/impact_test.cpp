#include "solver/step/impact/impact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::impact_test {
namespace {

/// Bodies on a line, of one velocity each: point k lies between bodies k and k + 1, its normal towards the first.
std::vector<ImpactPoint> row_of(const std::vector<double>& velocities, double restitution) {
  std::vector<ImpactPoint> points;
  for (std::size_t k = 0; k + 1 < velocities.size(); ++k) {
    ImpactPoint point{static_cast<int>(k), static_cast<int>(k) + 1, Eigen::Vector3d(-1, 0, 0),
                      Eigen::Vector3d(1, 0, 0)};
    point.velocity[0] = velocities[k + 1] - velocities[k];
    point.target = point.velocity[0] < 0.0 ? -restitution * point.velocity[0] : 0.0;
    points.push_back(point);
  }
  return points;
}

TEST(Impact, EqualBodiesExchangeTheirVelocities) {
  const ImpactResult result = solve_impact({2.0, 2.0}, {1, 1}, row_of({3.0, 0.0}, 1.0));
  EXPECT_NEAR(result.changes[0][0], -3.0, 1e-12);
  EXPECT_NEAR(result.changes[1][0], 3.0, 1e-12);
  EXPECT_NEAR(result.work, 0.0, 1e-12);
}

TEST(Impact, UnequalBodiesPartWithTheirRestitution) {
  // m 1 and 3, 2 m/s, e = 0.5: momentum 2 = v1 + 3 v2 and v2 - v1 = 1 give -0.25 and 0.75. Loss: 2 - 0.875 J.
  const ImpactResult result = solve_impact({1.0, 3.0}, {1, 1}, row_of({2.0, 0.0}, 0.5));
  EXPECT_NEAR(2.0 + result.changes[0][0], -0.25, 1e-12);
  EXPECT_NEAR(result.changes[1][0], 0.75, 1e-12);
  EXPECT_NEAR(result.work, -1.125, 1e-12);
}

TEST(Impact, AContactAtRestTransmitsTheImpulse) {
  // The second and the third body touch: they leave with one velocity. 1 = v1 + 2 v2, v2 - v1 = 1.
  const ImpactResult result = solve_impact({1.0, 1.0, 1.0}, {1, 1, 1}, row_of({1.0, 0.0, 0.0}, 1.0));
  EXPECT_NEAR(1.0 + result.changes[0][0], -1.0 / 3.0, 1e-12);
  EXPECT_NEAR(result.changes[1][0], 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(result.changes[2][0], 2.0 / 3.0, 1e-12);
}

TEST(Impact, ARowOfFiveThatTouchIsNoCradle) {
  // The last four leave as one: 1 = v1 + 4 v2, v2 - v1 = 1.
  const ImpactResult result =
      solve_impact({1.0, 1.0, 1.0, 1.0, 1.0}, {1, 1, 1, 1, 1}, row_of({1.0, 0.0, 0.0, 0.0, 0.0}, 1.0));
  EXPECT_NEAR(1.0 + result.changes[0][0], -0.6, 1e-11);
  for (const std::size_t k : {1U, 2U, 3U, 4U}) EXPECT_NEAR(result.changes[k][0], 0.4, 1e-11);
  EXPECT_NEAR(result.work, 0.0, 1e-11);
}

TEST(Impact, PassesThatEndTooSoonAreToldByTheResidual) {
  const std::vector<ImpactPoint> points = row_of({1.0, 0.0, 0.0}, 1.0);
  EXPECT_LT(solve_impact({1.0, 1.0, 1.0}, {1, 1, 1}, points).residual, 1e-12);
  EXPECT_GT(solve_impact({1.0, 1.0, 1.0}, {1, 1, 1}, points, {10, 10, 0}).residual, impact_accuracy);
}

TEST(Impact, PointsThatPartHaveNoImpulse) {
  std::vector<ImpactPoint> points = row_of({0.0, 1.0}, 1.0);
  const ImpactResult result = solve_impact({1.0, 1.0}, {1, 1}, points);
  EXPECT_EQ(result.impulses[0].norm(), 0.0);
  EXPECT_EQ(result.work, 0.0);
}

/// A point of a body of mass 1 that moves along (n, t1) against a wall.
ImpactPoint oblique(double across, double along, double restitution, double friction) {
  ImpactPoint point{0, -1, Eigen::Matrix3Xd::Identity(3, 2), {}};
  point.velocity = {across, along, 0.0};
  point.target = -restitution * across;
  point.friction = friction;
  return point;
}

TEST(Impact, FrictionIsBoundedByTheNormalImpulse) {
  // j = (1 + e) 2 = 3 N s. tan(phi) = 0.2 reduces 5 m/s by 0.6.
  const ImpactResult sliding = solve_impact({1.0}, {2}, {oblique(-2.0, 5.0, 0.5, 0.2)});
  EXPECT_NEAR(sliding.impulses[0][0], 3.0, 1e-12);
  EXPECT_NEAR(sliding.impulses[0][1], -0.6, 1e-12);
  // 0.5 m/s are stopped by less than the bound.
  const ImpactResult sticking = solve_impact({1.0}, {2}, {oblique(-2.0, 0.5, 0.5, 0.2)});
  EXPECT_NEAR(sticking.changes[0][1], -0.5, 1e-12);
}

TEST(Impact, BondedPointsKeepTheirRelativeVelocity) {
  std::vector<ImpactPoint> points = row_of({1.0, 0.0, 0.0}, 1.0);
  points[1].bonded = true;
  const ImpactResult result = solve_impact({1.0, 1.0, 1.0}, {1, 1, 1}, points);
  EXPECT_NEAR(result.changes[1][0], result.changes[2][0], 1e-12);
  // 1 kg at 1 m/s strikes 2 kg at rest, e = 1.
  EXPECT_NEAR(1.0 + result.changes[0][0], -1.0 / 3.0, 1e-12);
}

TEST(Impact, AnEccentricImpactWithFrictionGainsNoEnergy) {
  // A rod that leans: the tangential impulse turns it, and Newton's law alone would gain energy (Kane's paradox). One
  // point, velocities (n, t) of the centre and a spin of radius of gyration 1/sqrt(3).
  const double gyration = 1.0 / std::sqrt(3.0);
  for (const double angle : {0.3, 0.6, 1.0, 1.3}) {
    for (const double spin : {-3.0, 0.0, 3.0}) {
      Eigen::Matrix3Xd rows = Eigen::Matrix3Xd::Zero(3, 3);
      rows.row(0) << 1.0, 0.0, std::cos(angle) / gyration;
      rows.row(1) << 0.0, 1.0, -std::sin(angle) / gyration;
      ImpactPoint point{0, -1, rows, {}};
      const Eigen::Vector3d velocity(-1.0, -4.0, gyration * spin);
      point.velocity = rows * velocity;
      if (point.velocity[0] >= 0.0) continue;
      point.target = -0.9 * point.velocity[0];
      point.friction = 1.0;
      const ImpactResult result = solve_impact({1.0}, {3}, {point});
      const double before = 0.5 * velocity.squaredNorm();
      const double after = 0.5 * (velocity + result.changes[0]).squaredNorm();
      EXPECT_LE(after, before * (1.0 + 1e-12)) << angle << " " << spin;
      EXPECT_NEAR(after - before, result.work, 1e-12 * before);
      EXPECT_GE((point.velocity + rows * result.changes[0])[0], -1e-12);
    }
  }
}

}  // namespace
}  // namespace ashlar::impact_test

#include "solver/linear/splitting.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::splitting_test {
namespace {

using Eigen::Vector3d;

/// A body of stiffness 2 under a force of -6 at a gap of 1 from a wall, of penalty 2: it moves by -1, the wall pushes with 4.
struct PressedBody {
  std::vector<SplitPoint> points = std::vector<SplitPoint>(1);
  double change = 0.0;
  int solutions = 0;

  PressedBody() {
    points[0].first[0] = 1.0;
    points[0].penalty.setConstant(2.0);
  }
  bool solve_bodies() {
    ++solutions;
    change = (-6.0 + points[0].load()[0]) / (2.0 + points[0].penalty[0]);
    points[0].place[0] = points[0].first[0] + change;
    return true;
  }
  void project_points() {
    relax_and_project(points, [](std::size_t, const Vector3d& place, SplitPoint& point) {
      const double force = std::max(0.0, point.force[0] - point.penalty[0] * place[0]);
      point.copy[0] = place[0] + (force - point.force[0]) / point.penalty[0];
      point.force[0] = force;
    });
  }
  [[nodiscard]] double answer() const { return change; }
  [[nodiscard]] double residual() const { return std::abs(points[0].place[0]); }
};

TEST(Splitting, ABodyIsPressedOntoAWall) {
  PressedBody body;
  const SplitAnswer<double> found =
      solve_by_splitting<double>(body, {.passes = 40, .between_checks = 5, .enough = 1e-9});
  EXPECT_NEAR(found.best, -1.0, 1e-9);
  EXPECT_NEAR(body.points[0].force[0], 4.0, 1e-8);
  // The first pass errs by 1, each further one by a fifth of the one before.
  EXPECT_NEAR(found.residual, std::pow(0.2, 14), 1e-14);
  EXPECT_EQ(body.solutions, 15);
}

/// Residuals by pass.
struct GivenResiduals {
  std::vector<double> residuals;
  int pass = 0;
  int changes = 0;

  bool solve_bodies() { return ++pass <= static_cast<int>(residuals.size()); }
  void project_points() {}
  [[nodiscard]] int answer() const { return pass; }
  [[nodiscard]] double residual() const { return residuals[static_cast<std::size_t>(pass) - 1]; }
  void adapt() { ++changes; }
};

TEST(Splitting, TheBestCheckedAnswerIsReturned) {
  GivenResiduals system{{0.5, 3.0, 0.5, 1.0, 0.5, 2.0, 0.5}};
  const SplitAnswer<int> found = solve_by_splitting<int>(
      system, {.passes = 100, .between_checks = 2, .enough = 0.0, .between_changes = 4});
  EXPECT_EQ(found.best, 4);
  EXPECT_EQ(found.residual, 1.0);
  EXPECT_EQ(system.changes, 1);
}

TEST(Splitting, WithoutASolutionOfTheBodiesThereIsNoAnswer) {
  GivenResiduals system;
  EXPECT_TRUE(std::isinf(
      solve_by_splitting<int>(system, {.passes = 9, .between_checks = 1, .enough = 1.0}).residual));
}

TEST(Splitting, PointsAreOverRelaxed) {
  std::vector<SplitPoint> points(1);
  points[0].place[1] = 2.0;
  points[0].copy[1] = 1.0;
  relax_and_project(points, [](std::size_t k, const Vector3d& place, SplitPoint& point) {
    EXPECT_EQ(k, 0U);
    EXPECT_NEAR(place[1], 1.6 * 2.0 - 0.6, 1e-15);
    point.copy = place;
  });
  EXPECT_EQ(points[0].last[1], 1.0);
}

TEST(Splitting, PenaltiesFollowTheLargerChange) {
  std::vector<SplitPoint> points(2);  // the second has no penalty
  SplitPoint& point = points[0];
  point.penalty.setOnes();
  point.force[0] = 1.0;
  point.place[0] = 1.0;
  EXPECT_EQ(adapted_rho(1.0, points), 0.5) << "bodies and points differ, the points do not change";
  EXPECT_EQ(adapted_rho(1e-6, points), 1e-6) << "a limit";
  point.copy[0] = 1.0;
  EXPECT_EQ(adapted_rho(1.0, points), 2.0) << "the points change, and are where the bodies are";
  point.place[0] = 2.0;
  EXPECT_EQ(adapted_rho(1.0, points), 1.0) << "both are alike";
}

}  // namespace
}  // namespace ashlar::splitting_test

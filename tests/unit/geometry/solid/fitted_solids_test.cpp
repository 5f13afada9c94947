#include "geometry/solid/fitted_solids.hpp"

#include <gmock/gmock.h>

#include <random>

#include "geometry/solid/hull_solid.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar {
namespace {

FitLimits within(double fit) {
  return {fit, 10.0 * fit, 0.5, 1e-3, 0x1p-46};
}

using ::testing::SizeIs;

// A wall of 4 x 1 x 3 boxes of 1 x 0.5 x 0.5 m in running bond, as a survey gives them: each corner by itself,
// wrong by up to `error` in each coordinate.
std::vector<std::optional<Polyhedron>> surveyed_wall(double error) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> off(-error, error);
  std::vector<std::optional<Polyhedron>> solids;
  for (int course = 0; course < 3; ++course)
    for (int brick = 0; brick < 4; ++brick) {
      const double x = brick + 0.5 * (course % 2), z = 0.5 * course;
      std::vector<Vector3> corners;
      for (int k = 0; k < 8; ++k)
        corners.emplace_back(x + k % 2 + off(random), 0.5 * (k / 2 % 2) + off(random),
                             z + 0.5 * (k / 4) + off(random));
      solids.emplace_back(make_hull_solid(corners, 0.0));
    }
  return solids;
}

TEST(FitSolids, PutsNeighboursOnCommonPlanes) {
  auto solids = surveyed_wall(1e-4);
  std::size_t bent = 0;
  for (const auto& solid : solids) bent += solid->faces().size() > 6 ? 1 : 0;
  EXPECT_EQ(bent, 12U) << "corners that were measured one by one lie in no plane";
  const SolidFit fit = fit_solids(solids, within(5e-4));
  EXPECT_EQ(fit.solids, 12U);
  EXPECT_EQ(fit.corners, 96U);
  // A corner is wrong by up to 1e-4 in each coordinate, and so are the planes.
  EXPECT_LT(fit.farthest, 1e-3);
  EXPECT_GT(fit.farthest, 1e-5);
  // Two bed joints; 3 upright joints in each course.
  EXPECT_EQ(fit.planes, 2U + 9U);
  for (const auto& solid : solids) {
    EXPECT_THAT(solid->faces(), SizeIs(6));
    EXPECT_NEAR(solid->volume(), 0.25, 1e-3);
  }
  // The lower corners of the second course lie on the upper plane of the first one.
  const PolyhedronFace* top = nullptr;
  for (const PolyhedronFace& face : solids[0]->faces())
    if (face.normal.z() > 0.9) top = &face;
  ASSERT_NE(top, nullptr);
  const Vector3 on_top = solids[0]->mesh().points[static_cast<std::size_t>(top->loops[0][0])];
  for (std::size_t s = 4; s < 8; ++s)
    for (const Vector3& point : solids[s]->mesh().points)
      if (point.z() < 0.75) {
        EXPECT_NEAR(top->normal.dot(point - on_top), 0.0, 1e-14);
      }
}

TEST(FitSolids, LeavesWhatFitsToTheBit) {
  std::vector<std::optional<Polyhedron>> solids;
  solids.emplace_back(make_box({0, 0, 0}, {0.1, 0.2, 0.3}));
  solids.emplace_back(make_box({0.1, 0, 0}, {0.3, 0.2, 0.3}));
  solids.emplace_back(std::nullopt);
  solids.emplace_back(make_box({5, 0, 0}, {6, 1, 1}));
  const auto before = solids;
  const SolidFit fit = fit_solids(solids, within(1e-3));
  EXPECT_EQ(fit.corners + fit.solids, 0U);
  EXPECT_EQ(fit.planes, 1U);
  for (const std::size_t k : {0U, 1U, 3U}) EXPECT_EQ(solids[k]->mesh().points, before[k]->mesh().points);
}

TEST(FitSolids, LeavesWhatIsApart) {
  std::vector<std::optional<Polyhedron>> solids;
  solids.emplace_back(make_box({0, 0, 0}, {1, 1, 1}));
  solids.emplace_back(make_box({0, 0, 1.01}, {1, 1, 2}));
  EXPECT_EQ(fit_solids(solids, within(1e-3)).planes, 0U);
  EXPECT_EQ(fit_solids(solids, within(6e-3)).planes, 1U);
  // Both go half way.
  EXPECT_NEAR(solids[0]->volume(), 1.005, 1e-12);
  EXPECT_NEAR(solids[1]->volume(), 0.995, 1e-12);
}

TEST(FitSolids, RefusesWhatLeavesNoSolid) {
  std::vector<std::optional<Polyhedron>> solids;
  solids.emplace_back(make_box({0, 0, 0}, {1, 1, 1}));
  solids.emplace_back(make_box({0, 0, 1}, {1, 1, 1.001}));
  solids.emplace_back(make_box({0, 0, 1.001}, {1, 1, 2}));
  EXPECT_THROW(fit_solids(solids, within(0.1)), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar

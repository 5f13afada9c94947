#include "solver/fracture/stress_average.hpp"

#include <gtest/gtest.h>

#include "support/simulations.hpp"

namespace ashlar::stress_average_test {
namespace {

constexpr double young = 1e9;

/// A beam along x, 4 by 1 by 1 m.
BlockModel beam(int order) {
  return BlockModel(
      test_support::block_of("beam", Polyhedron(make_box({0, 0, 0}, {4, 1, 1})), {2500, young, 0.0}, order));
}

/// The state whose motion at the points that determine a polynomial is given.
template <class Motion>
BlockState state_of(const BlockModel& block, const Motion& motion) {
  BlockState state = block.initial_state();
  const std::vector<Vector3> points = block.basis().sample_points();
  Eigen::MatrixX3d places(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k)
    places.row(static_cast<Eigen::Index>(k)) = motion(points[k]).transpose();
  state.position = block.basis().values(points).householderQr().solve(places);
  return state;
}

/// Curvature 1e-5/m: stress E 1e-5 (z - 1/2) along x.
Vector3 bent(const Vector3& X) {
  constexpr double curvature = 1e-5;
  const double z = X.z() - 0.5, x = X.x() - 2.0;
  return {X.x() + curvature * x * z, X.y(), X.z() - 0.5 * curvature * x * x};
}

TEST(StressAverage, UniformTensionIsItselfAndDividesAcrossItAtTheCentroid) {
  const BlockModel block = beam(2);
  const BlockState state =
      state_of(block, [](const Vector3& X) { return Vector3(1.001 * X.x(), X.y(), X.z()); });
  const StressProbes probes = stress_probes(block, 0.2);
  const auto place = weakest_place(block, state, probes, 0.999e6);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->stress, 1e6, 1e-3);
  EXPECT_EQ(place->plane.normal, Vector3(1, 0, 0));
  EXPECT_LT((place->plane.point - Vector3(2, 0.5, 0.5)).norm(), 1e-12);
  EXPECT_FALSE(weakest_place(block, state, probes, 1.001e6));
}

// Over half of a ball of the diameter s the mean distance from its flat side is 3 s/16: at the surface of a bent beam of the
// depth h the mean is that of the largest stress less 3/8 s/h of it; over a quarter at an edge the same.
TEST(StressAverage, AtTheSurfaceOfABentBeamItIsThatOfHalfABall) {
  constexpr double size = 0.2, edge = 0.5 * 1e-5 * young;
  for (const int order : {2, 4}) {
    const BlockModel block = beam(order);
    const BlockState state = state_of(block, bent);
    const auto place = weakest_place(block, state, stress_probes(block, size), 0.5 * edge);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->stress, edge * (1.0 - 3.0 / 8.0 * size), 0.01 * edge) << order;
    EXPECT_EQ(place->plane.point.z(), 1.0);
    EXPECT_EQ(place->plane.normal, Vector3(1, 0, 0));
  }
}

TEST(StressAverage, FollowsABlockThatHasTurned) {
  const BlockModel block = beam(2);
  const Eigen::AngleAxisd turn(1.1, Vector3(1, 2, 3).normalized());
  const StressProbes probes = stress_probes(block, 0.2);
  const auto still = weakest_place(block, state_of(block, bent), probes, 1.0);
  const auto turned = weakest_place(
      block, state_of(block, [&](const Vector3& X) { return Vector3(turn * bent(X)); }), probes, 1.0);
  ASSERT_TRUE(still && turned);
  EXPECT_NEAR(still->stress, turned->stress, 1e-3);
  EXPECT_EQ(still->plane.point, turned->plane.point);
  EXPECT_EQ(still->plane.normal, turned->plane.normal);
}

}  // namespace
}  // namespace ashlar::stress_average_test

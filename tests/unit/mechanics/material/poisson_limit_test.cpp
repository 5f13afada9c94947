#include "mechanics/material/poisson_limit.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar::poisson_limit_test {
namespace {

// Largest component of the stress over E of a block that has only been moved and turned: all of it is false.
double false_stress(int order, double poisson_ratio) {
  BlockDefinition definition;
  definition.name = "block";
  definition.solid = std::make_shared<const Polyhedron>(make_box({-0.5, -0.7, 0.1}, {0.8, 0.4, 1.2}));
  definition.material = {2500, 1e9, poisson_ratio};
  definition.order = order;
  const BlockModel block(definition);
  double most = 0.0;
  for (int k = 1; k <= 20; ++k) {
    const Eigen::AngleAxisd turn(0.37 * k, Vector3(std::sin(k), std::cos(3.0 * k), 0.3).normalized());
    BlockState state = block.initial_state();
    state.position = state.position * turn.toRotationMatrix().transpose();
    state.position.row(0) += 0.1 * k * std::sqrt(block.basis().volume()) * Eigen::RowVector3d(1.0, -0.7, 0.2);
    for (const Vector3& corner : block.solid().mesh().points)
      most = std::max(most, block.stress(state, corner).cwiseAbs().maxCoeff());
  }
  return most / block.material().young_modulus;
}

TEST(PoissonLimit, RoundingLeavesStressesRightUpToTheLimit) {
  for (const int order : {1, 2, 3, 5, 8}) {
    EXPECT_LT(false_stress(order, largest_poisson_ratio(order)), 1e-8) << order;
    // Ten thousand times nearer to 0.5 it does not: the limit is not too strict.
    const double nearer = 0.5 - 1e-4 * (0.5 - largest_poisson_ratio(order));
    EXPECT_GT(false_stress(order, nearer), 1e-7) << order;
  }
}

TEST(PoissonLimit, FallsWithTheOrder) {
  for (int order = 1; order < 12; ++order)
    EXPECT_GT(largest_poisson_ratio(order), largest_poisson_ratio(order + 1));
  EXPECT_GT(largest_poisson_ratio(12), 0.4999);
  EXPECT_LT(largest_poisson_ratio(1), 0.5 - 1e-8);
}

}  // namespace
}  // namespace ashlar::poisson_limit_test

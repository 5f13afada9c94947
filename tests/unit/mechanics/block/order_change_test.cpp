#include "mechanics/block/order_change.hpp"

#include <gtest/gtest.h>

#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::order_change_test {
namespace {

BlockModel model(const std::shared_ptr<const Polyhedron>& solid, int order, bool clamped) {
  BlockDefinition definition = test_support::block_of("A", *solid, {2000, 1e8, 0.2}, order);
  definition.solid = solid;
  if (clamped) definition.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  return BlockModel(std::move(definition));
}

/// A deformed, moving state in the block's admissible space.
BlockState some_state(const BlockModel& block) {
  const Eigen::VectorXd y =
      0.05 * Eigen::VectorXd::LinSpaced(block.unknowns(), -1.0, 2.0).array().sin().matrix();
  return {block.basis().identity_map() + block.space().expand(y),
          block.space().expand(Eigen::VectorXd(3.0 * y))};
}

TEST(OrderChange, RaisingAndLoweringAgainLosesNothing) {
  const auto solid = std::make_shared<const Polyhedron>(test_support::l_shaped_prism());
  for (const bool clamped : {false, true}) {
    const BlockModel low = model(solid, 2, clamped);
    const BlockModel high = model(solid, 5, clamped);
    const BlockState state = some_state(low);
    const OrderChange raised = change_order(low, state, high);
    EXPECT_LT(raised.dropped_displacement, 1e-12);
    EXPECT_LT(raised.dropped_velocity, 1e-12);
    EXPECT_NEAR(high.elastic(raised.state.position).energy, low.elastic(state.position).energy,
                1e-9 * low.elastic(state.position).energy);
    for (const Vector3& point : solid->mesh().points) {
      const Vector3 before = state.position.transpose() * low.basis().values(point);
      const Vector3 after = raised.state.position.transpose() * high.basis().values(point);
      EXPECT_LT((before - after).norm(), 1e-12);
    }
    const OrderChange back = change_order(high, raised.state, low);
    EXPECT_LT((back.state.position - state.position).norm(), 1e-12);
    EXPECT_LT(back.dropped_displacement, 1e-12);
  }
}

TEST(OrderChange, LoweringReportsWhatItDrops) {
  // One coefficient of 0.3 m on a function of order 3 has a root mean square of 0.3 / sqrt(V).
  const auto solid = std::make_shared<const Polyhedron>(test_support::l_shaped_prism());
  const BlockModel high = model(solid, 3, false);
  const BlockModel low = model(solid, 2, false);
  BlockState state = high.initial_state();
  state.position(15, 1) += 0.3;
  state.velocity(12, 0) = 2.0;
  const OrderChange lowered = change_order(high, state, low);
  EXPECT_NEAR(lowered.dropped_displacement, 0.3 / std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(lowered.dropped_velocity, 2.0 / std::sqrt(3.0), 1e-14);
  EXPECT_LT((lowered.state.position - low.basis().identity_map()).norm(), 1e-13);
}

TEST(OrderChange, ClampsHoldInTheLowerOrder) {
  const auto solid = std::make_shared<const Polyhedron>(Polyhedron(make_box({0, 0, 0}, {2, 1, 1})));
  const BlockModel high = model(solid, 6, true);
  const BlockModel low = model(solid, 2, true);
  const OrderChange lowered = change_order(high, some_state(high), low);
  EXPECT_GT(lowered.dropped_displacement, 0.0);
  for (const Vector3& point : {Vector3(0, 0, 0), Vector3(0, 0.4, 0.7), Vector3(0, 1, 1)})
    EXPECT_LT((lowered.state.position.transpose() * low.basis().values(point) - point).norm(), 1e-12);
}

TEST(OrderChange, RefusesModelsOfOtherSolids) {
  const auto one = std::make_shared<const Polyhedron>(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  const auto other = std::make_shared<const Polyhedron>(Polyhedron(make_box({0, 0, 0}, {1, 1, 2})));
  const BlockModel a = model(one, 1, false);
  EXPECT_THROW((void)change_order(a, a.initial_state(), model(other, 2, false)), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::order_change_test

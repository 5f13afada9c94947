#include "mechanics/block/material_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <memory>

#include "geometry/solid/shapes.hpp"

namespace ashlar::material_map_test {
namespace {

BlockModel block_of_order(int order) {
  BlockDefinition definition;
  definition.name = "block";
  definition.solid = std::make_shared<const Polyhedron>(make_box({0, 0, 0}, {1, 2, 3}));
  definition.material = {2500.0, 1e9, 0.2};
  definition.order = order;
  return BlockModel(std::move(definition));
}

const std::vector<Vector3> points = {{0, 0, 0}, {1, 2, 3}, {0.3, 0.4, 0.5}, {0.5, 2, 1}, {1, 0, 2.5}};

TEST(MaterialMap, TakesPointsOfATurnedAndStretchedBlockBack) {
  for (const int order : {1, 3}) {
    const BlockModel model = block_of_order(order);
    BlockState state = model.initial_state();
    Eigen::Matrix3d gradient = Eigen::AngleAxisd(2.0, Vector3(1, -2, 3).normalized()).toRotationMatrix();
    gradient.col(1) *= 1.2;
    state.position = state.position * gradient.transpose();
    const MaterialMap map(model, state);
    for (const Vector3& point : points) {
      const auto back = map.material(gradient * point);
      ASSERT_TRUE(back);
      EXPECT_NEAR((*back - point).norm(), 0.0, 1e-13);
    }
    // A layer across y is stretched by 1.2.
    EXPECT_NEAR(map.stretch_across({0.5, 1, 1}, Vector3::UnitY()), 1.2, 1e-13);
    EXPECT_NEAR(map.stretch_across({0.5, 1, 1}, Vector3::UnitX()), 1.0, 1e-13);
  }
}

TEST(MaterialMap, TakesPointsOfABentBlockBack) {
  const BlockModel model = block_of_order(2);
  BlockState state = model.initial_state();
  // x' = x + 0.02 z^2, by its values: any polynomial of order 2 is met by the basis.
  std::vector<Vector3> nodes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) nodes.emplace_back(0.5 * i, j, 1.5 * k);
  Eigen::MatrixX3d places(27, 3);
  const auto bent = [](const Vector3& x) { return Vector3(x.x() + 0.02 * x.z() * x.z(), x.y(), x.z()); };
  for (int k = 0; k < 27; ++k) places.row(k) = bent(nodes[static_cast<std::size_t>(k)]);
  state.position = model.basis().values(nodes).colPivHouseholderQr().solve(places);
  const MaterialMap map(model, state);
  for (const Vector3& point : points) {
    const auto back = map.material(bent(point));
    ASSERT_TRUE(back);
    EXPECT_NEAR((*back - point).norm(), 0.0, 1e-11);
  }
}

TEST(MaterialMap, ABlockTurnedInsideOutHasNone) {
  const BlockModel model = block_of_order(1);
  BlockState state = model.initial_state();
  state.position.col(0) *= -1.0;
  EXPECT_FALSE(MaterialMap(model, state).material({-0.5, 1, 1}));
}

}  // namespace
}  // namespace ashlar::material_map_test

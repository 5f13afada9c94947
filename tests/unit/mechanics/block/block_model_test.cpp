#include "mechanics/block/block_model.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::block_model_test {
namespace {

using test_support::block_of;

BlockDefinition cantilever(int order, double poisson_ratio, double degrees = 0.0,
                           const Vector3& shift = Vector3::Zero()) {
  const Polyhedron box(make_box({0, -1.5, -0.5}, {8, 1.5, 0.5}));
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vector3> points;
  for (const Vector3& point : box.mesh().points) points.emplace_back(turn * point + shift);
  BlockDefinition block = block_of("B", degrees == 0.0 && shift.isZero() ? box : box.with_points(points),
                                   {3600.0, 1e9, poisson_ratio}, order);
  block.supports.push_back({Plane{shift, turn * Vector3(-1, 0, 0)}});
  return block;
}

/// Deflection of the end's centroid under gravity along the box's own -z.
double self_weight_deflection(int order, double poisson_ratio, double degrees = 0.0,
                              const Vector3& shift = Vector3::Zero()) {
  const BlockModel block(cantilever(order, poisson_ratio, degrees, shift));
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3 down = turn * Vector3(0, 0, -1);
  const auto position = block.equilibrium(9.81 * down, 0.0);
  EXPECT_TRUE(position.has_value());
  const Vector3 point = turn * Vector3(8, 0, 0) + shift;
  return down.dot(
      Vector3((*position - block.basis().identity_map()).transpose() * block.basis().values(point)));
}

// References of record, computed independently of this program.
TEST(BlockModel, CantileverUnderItsOwnWeight) {
  EXPECT_NEAR(self_weight_deflection(1, 0.0), 0.002260224, 1e-6 * 0.002260224);
  EXPECT_NEAR(self_weight_deflection(2, 0.0), 0.146914560, 1e-6 * 0.146914560);
  EXPECT_NEAR(self_weight_deflection(3, 0.0), 0.219241728, 1e-6 * 0.219241728);
  EXPECT_NEAR(self_weight_deflection(3, 0.2), 0.2017689, 1e-6 * 0.2017689);
}

TEST(BlockModel, CantileverTurnsAndMovesWithTheBlock) {
  for (const int order : {1, 3, 6}) {
    const double straight = self_weight_deflection(order, 0.2);
    EXPECT_NEAR(self_weight_deflection(order, 0.2, 37.0, {12, -30, 5}), straight, 1e-9 * straight) << order;
  }
}

TEST(BlockModel, CantileverWithAnEndLoad) {
  // Order and nu: 1 MN of shear on the end face; references of record.
  const auto deflection = [](int order, double poisson_ratio) {
    BlockDefinition definition = cantilever(order, poisson_ratio);
    Load load;
    load.where = Plane{{8, 0, 0}, {1, 0, 0}};
    load.traction = false;
    load.vector = {0, 0, -1e6};
    definition.loads.push_back(load);
    const BlockModel block(definition);
    const auto position = block.equilibrium(Vector3::Zero(), 0.0);
    return -((*position - block.basis().identity_map()).transpose() * block.basis().values(Vector3(8, 0, 0)))
                .z();
  };
  EXPECT_NEAR(deflection(1, 0.0), 0.00533333, 1e-6 * 0.0053 + 5e-9);
  EXPECT_NEAR(deflection(2, 0.0), 0.51733333, 1e-6 * 0.52);
  EXPECT_NEAR(deflection(3, 0.0), 0.68800000, 1e-6 * 0.69);
  EXPECT_NEAR(deflection(2, 0.2), 0.4672000, 1e-6 * 0.47);
  EXPECT_NEAR(deflection(3, 0.2), 0.6386072, 1e-6 * 0.64);
  EXPECT_NEAR(deflection(5, 0.2), 0.6737756, 1e-6 * 0.67);
}

TEST(BlockModel, UniformTractionGivesUniformStress) {
  // sigma = diag(p, 0, 0) on an L-shaped prism: tractions sigma n on all faces keep it in equilibrium,
  // supports at three points take no force, so the stress is exact for every order.
  for (int order = 1; order <= 6; ++order) {
    BlockDefinition definition = block_of("L", test_support::l_shaped_prism(), {1.0, 2.5e9, 0.3}, order);
    definition.supports.push_back({Vector3(0, 0, 0)});
    definition.supports.push_back({Vector3(0, 2, 0), {true, false, true}});
    definition.supports.push_back({Vector3(2, 0, 0), {false, false, true}});
    for (const auto& [point, normal, sign] : {std::tuple{Vector3(0, 0, 0), Vector3(1, 0, 0), -1.0},
                                              std::tuple{Vector3(2, 0, 0), Vector3(1, 0, 0), 1.0},
                                              std::tuple{Vector3(1, 2, 0), Vector3(1, 0, 0), 1.0}}) {
      Load load;
      load.where = Plane{point, normal};
      load.vector = sign * Vector3(1e6, 0, 0);
      definition.loads.push_back(load);
    }
    const BlockModel block(definition);
    const auto position = block.equilibrium(Vector3::Zero(), 0.0);
    ASSERT_TRUE(position.has_value());
    BlockState state = block.initial_state();
    state.position = *position;
    for (const Vector3& point : {Vector3(0.3, 0.4, 0.5), Vector3(1.9, 0.1, 0.9), Vector3(0.1, 1.9, 0.2)}) {
      const Eigen::Matrix3d expected = Vector3(1e6, 0, 0).asDiagonal();
      EXPECT_LT((block.stress(state, point) - expected).norm(), 1e-9 * 1e6) << order;
    }
  }
}

TEST(BlockModel, ClampedFaceStaysExactlyInPlace) {
  const BlockModel block(cantilever(5, 0.2));
  EXPECT_EQ(block.unknowns(), 3 * (polynomial_count(5) - 21));  // 21 = polynomials of order 5 on a plane
  EXPECT_FALSE(block.corotational());
  const auto position = block.equilibrium({0, 0, -9.81}, 0.0);
  for (const Vector3& point : {Vector3(0, -1.5, -0.5), Vector3(0, 0.3, 0.2), Vector3(0, 1.5, 0.5)}) {
    EXPECT_LT((position->transpose() * block.basis().values(point) - point).norm(), 1e-12);
  }
}

TEST(BlockModel, EnergyAndForceDoNotChangeUnderRotation) {
  const BlockModel block(block_of("A", test_support::l_shaped_prism(), {2000.0, 1e8, 0.25}, 3));
  Eigen::MatrixX3d q = block.basis().identity_map();
  for (Eigen::Index a = 0; a < q.rows(); ++a)
    q.row(a) += 0.02 * Vector3(std::sin(a + 1.0), std::cos(2.0 * a), std::sin(3.0 * a)).transpose();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  const ElasticResponse straight = block.elastic(q);
  const ElasticResponse turned = block.elastic(q * turn.transpose());
  EXPECT_NEAR(turned.energy, straight.energy, 1e-11 * straight.energy);
  EXPECT_LT((turned.force - straight.force * turn.transpose()).norm(), 1e-10 * straight.force.norm());
  Vector3 torque = Vector3::Zero();
  for (Eigen::Index a = 0; a < q.rows(); ++a)
    torque += Vector3(q.row(a)).cross(Vector3(straight.force.row(a)));
  EXPECT_LT(torque.norm(), 1e-10 * straight.force.norm() * q.norm());
}

TEST(BlockModel, ElasticForceIsTheGradientOfTheEnergy) {
  const BlockModel block(block_of("A", test_support::l_shaped_prism(), {2000.0, 1e8, 0.25}, 2));
  Eigen::MatrixX3d q = block.basis().identity_map();
  for (Eigen::Index a = 0; a < q.rows(); ++a)
    q.row(a) += 0.05 * Vector3(std::sin(a + 1.0), std::cos(2.0 * a), std::sin(3.0 * a)).transpose();
  const ElasticResponse response = block.elastic(q);
  const double h = 1e-6;
  for (Eigen::Index a = 0; a < q.rows(); ++a) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      Eigen::MatrixX3d plus = q;
      Eigen::MatrixX3d minus = q;
      plus(a, i) += h;
      minus(a, i) -= h;
      const double difference = (block.elastic(plus).energy - block.elastic(minus).energy) / (2 * h);
      EXPECT_NEAR(difference, response.force(a, i), 1e-6 * response.force.norm());
    }
  }
}

TEST(BlockModel, ProductsWithTheTangentAreThoseOfItsMatrix) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.3, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  std::vector<BlockModel> blocks;
  for (const int order : {1, 4})  // free
    blocks.emplace_back(block_of("A", test_support::l_shaped_prism(), {2000.0, 1e8, 0.25}, order));
  blocks.emplace_back(cantilever(3, 0.2));  // cannot turn
  BlockDefinition hinged = cantilever(3, 0.2);
  hinged.supports[0].components = {true, false, false};
  blocks.emplace_back(hinged);  // turns about the normal of its support
  for (const BlockModel& block : blocks) {
    ASSERT_TRUE(block.tangent_turns());
    Eigen::VectorXd y(block.unknowns());
    for (Eigen::Index k = 0; k < y.size(); ++k) y[k] = std::sin(1.0 + 3.0 * static_cast<double>(k));
    const Eigen::VectorXd expected = block.tangent(turn) * y;
    EXPECT_LT((block.tangent_times(turn, y) - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST(BlockModel, RefusesAClampOnNoFace) {
  BlockDefinition definition = cantilever(2, 0.2);
  definition.supports.push_back({Plane{{4, 0, 0}, {1, 0, 0}}});
  EXPECT_THROW(BlockModel{definition}, std::invalid_argument);
}

TEST(BlockModel, SupportsThatLeaveARotationAreSeen) {
  BlockDefinition definition = block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {1.0, 1.0, 0.0}, 2);
  definition.supports.push_back({Vector3(0, 0, 0)});
  EXPECT_TRUE(BlockModel(definition).corotational());
  definition.supports.push_back({Vector3(1, 0, 0)});
  EXPECT_TRUE(BlockModel(definition).corotational());  // a hinge
  definition.supports.push_back({Vector3(0, 1, 0), {false, false, true}});
  EXPECT_FALSE(BlockModel(definition).corotational());
  EXPECT_TRUE(BlockModel(definition).equilibrium({0, 0, -1}, 0.0).has_value());
}

TEST(BlockModel, ASlidingSupportHasNoEquilibrium) {
  BlockDefinition definition = block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {1.0, 1.0, 0.0}, 2);
  definition.supports.push_back({Plane{{0, 0, 0}, {0, 0, 1}}, {false, true, true}});
  EXPECT_FALSE(BlockModel(definition).corotational());
  EXPECT_FALSE(BlockModel(definition).equilibrium({0, 0, -1}, 0.0).has_value());
}

}  // namespace
}  // namespace ashlar::block_model_test

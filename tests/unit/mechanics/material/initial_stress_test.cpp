#include "mechanics/material/initial_stress.hpp"

#include <gtest/gtest.h>

#include "geometry/solid/shapes.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar::initial_stress_test {
namespace {

BlockModel stressed_box(int order, StressField stress) {
  BlockDefinition block;
  block.name = "rock";
  block.solid = std::make_shared<const Polyhedron>(make_box({0, 0, 0}, {2, 1, 3}));
  block.material = {2500.0, 1e9, 0.25};
  block.order = order;
  block.initial_stress = std::move(stress);
  return BlockModel(std::move(block));
}

Eigen::Matrix3d tensor(double xx, double yy, double zz, double xy, double yz, double zx) {
  return (Eigen::Matrix3d() << xx, xy, zx, xy, yy, yz, zx, yz, zz).finished();
}

TEST(InitialStress, AUniformOneIsThatOfTheBlockAsPlaced) {
  const Eigen::Matrix3d stress = tensor(-3e5, -1e5, -5e5, 2e4, -1e4, 4e4);
  for (const int order : {1, 2, 3}) {
    const BlockModel block = stressed_box(order, [&](const Vector3&) { return stress; });
    EXPECT_LT((block.stress(block.initial_state(), {0.3, 0.9, 2.0}) - stress).norm(), 1e-6) << order;
  }
}

// Linear strain is compatible: order 2 can have any linear stress, order 1 its mean.
TEST(InitialStress, OneThatGrowsWithDepthNeedsOrderTwo) {
  const StressField stress = [](const Vector3& x) { return tensor(1e4 * x.z(), 0, 3e4 * x.z(), 0, 0, 0); };
  const BlockModel second = stressed_box(2, stress);
  EXPECT_LT((second.stress(second.initial_state(), {0.3, 0.9, 2.0}) - stress({0, 0, 2.0})).norm(), 1e-6);
  const BlockModel first = stressed_box(1, stress);
  EXPECT_LT((first.stress(first.initial_state(), {0.3, 0.9, 2.0}) - stress({0, 0, 1.5})).norm(), 1e-6);
}

// Tractions s n over the surface do the work of the internal force: on x -> (z, 0, 0) that is s_xz times the volume.
TEST(InitialStress, ItsForceIsThatOfTractions) {
  const BlockModel block = stressed_box(1, [](const Vector3&) { return tensor(-3, -1, -5, 2, -1, 4); });
  const Eigen::MatrixX3d force = block.elastic(block.initial_state().position).force;
  const Eigen::MatrixX3d shear = block.basis().linear_field(
      Vector3::Zero(), (Eigen::Matrix3d() << 0, 0, 1, 0, 0, 0, 0, 0, 0).finished());
  EXPECT_NEAR(force.cwiseProduct(shear).sum(), 4.0 * 6.0, 1e-6);
  EXPECT_LT(force.row(0).norm(), 1e-9);
}

// The block turns as a whole: the stress turns with it, and its energy stays.
TEST(InitialStress, TurnsWithTheBlock) {
  const Eigen::Matrix3d stress = tensor(-3e5, -1e5, -5e5, 2e4, -1e4, 4e4);
  const BlockModel block = stressed_box(2, [&](const Vector3&) { return stress; });
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  BlockState state = block.initial_state();
  const double energy = block.elastic(state.position).energy;
  state.position = state.position * turn.transpose();
  EXPECT_LT((block.stress(state, {0.3, 0.9, 2.0}) - turn * stress * turn.transpose()).norm(), 1e-5);
  EXPECT_NEAR(block.elastic(state.position).energy, energy, 1e-9 * energy);
}

TEST(InitialStress, NeedsLinearElasticity) {
  BlockDefinition block;
  block.solid = std::make_shared<const Polyhedron>(make_box({0, 0, 0}, {1, 1, 1}));
  block.material = {2500.0, 1e9, 0.25, Elasticity::st_venant_kirchhoff};
  block.initial_stress = [](const Vector3&) { return Eigen::Matrix3d(Eigen::Matrix3d::Identity()); };
  EXPECT_THROW(BlockModel{block}, std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::initial_stress_test

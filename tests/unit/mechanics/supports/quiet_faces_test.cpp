#include "mechanics/supports/quiet_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "mechanics/block/block_model.hpp"
#include "support/simulations.hpp"

namespace ashlar::quiet_faces_test {
namespace {

/// lambda = mu = 8e7 Pa: rho c_s = sqrt(2000 * 8e7) = 4e5 Pa s/m, rho c_p = sqrt(3) times that.
const Material soil{2000.0, 2e8, 0.25};
constexpr double across = 4e5;
const double along = std::sqrt(3.0) * across;

Polyhedron box() {
  return Polyhedron(make_box({0, 0, 0}, {3, 2, 1}));
}
const Plane base{{0, 0, 0}, -Vector3::UnitZ()};

BlockDefinition quiet_block(int order = 2) {
  BlockDefinition block = test_support::block_of("soil", box(), soil, order);
  block.quiet.push_back({.where = FaceList{outer_faces(*block.solid, base)}});
  return block;
}

BlockModel released(const BlockDefinition& definition) {
  BlockPartsLibrary library;
  return BlockModel(definition).with_quiet_faces(true, library);
}

TEST(QuietFaces, ImpedanceIsThatOfWavesAlongAndAcross) {
  EXPECT_NEAR((impedance(soil, Vector3::UnitZ()) * Vector3::UnitZ() - along * Vector3::UnitZ()).norm(), 0.0,
              1e-6);
  EXPECT_NEAR((impedance(soil, Vector3::UnitZ()) * Vector3::UnitX() - across * Vector3::UnitX()).norm(), 0.0,
              1e-6);
  // 45 degrees: half of each along z, and their difference across.
  const Vector3 normal = Vector3(1, 0, 1).normalized();
  const Vector3 traction = impedance(soil, normal) * Vector3::UnitZ();
  EXPECT_NEAR(traction.z(), 0.5 * (along + across), 1e-6);
  EXPECT_NEAR(traction.x(), 0.5 * (along - across), 1e-6);
}

TEST(QuietFaces, FacesAreThoseThatLookOutwards) {
  EXPECT_EQ(outer_faces(box(), base).size(), 1U);
  EXPECT_TRUE(outer_faces(box(), {{0, 0, 0}, Vector3::UnitZ()}).empty());
  EXPECT_TRUE(outer_faces(box(), {{0, 0, 0.5}, -Vector3::UnitZ()}).empty());
}

// v = (0, 0, x) on the face 3 x 2: power rho c_p (27 / 3) 2; v = (z, 1, 0): rho c_s 6.
TEST(QuietFaces, DashpotsDissipateTheIntegralOfTractionAndVelocity) {
  const BlockModel block = released(quiet_block());
  ASSERT_NE(block.dashpots(), nullptr);
  const auto power = [&](const Vector3& at_centroid, const Eigen::Matrix3d& gradient) {
    const Eigen::VectorXd y = block.space().restrict(block.basis().linear_field(at_centroid, gradient));
    return y.dot(*block.dashpots() * y);
  };
  Eigen::Matrix3d of_x = Eigen::Matrix3d::Zero(), of_z = Eigen::Matrix3d::Zero();
  of_x(2, 0) = 1.0;
  of_z(0, 2) = 1.0;
  const Vector3 middle = block.basis().centroid();
  EXPECT_NEAR(power(of_x * middle, of_x) / (along * 18.0), 1.0, 1e-12);
  EXPECT_NEAR(power(of_z * middle + Vector3::UnitY(), of_z) / (across * 6.0), 1.0, 1e-12);
  EXPECT_NEAR((*block.dashpots() - block.dashpots()->transpose()).norm(), 0.0, 1e-9 * along);
}

TEST(QuietFaces, AreHeldUntilTheyAreReleased) {
  const BlockModel held(quiet_block(1));
  EXPECT_TRUE(held.quiet());
  EXPECT_TRUE(held.supported());
  EXPECT_TRUE(held.space().held());
  EXPECT_EQ(held.dashpots(), nullptr);
  // Of 1, x, y and z only z - 0 vanishes on the base.
  EXPECT_EQ(held.unknowns(), 3);
  BlockPartsLibrary library;
  const BlockModel free = held.with_quiet_faces(true, library);
  EXPECT_FALSE(free.supported());
  EXPECT_FALSE(free.corotational());
  EXPECT_EQ(free.unknowns(), 12);
  EXPECT_EQ(free.with_quiet_faces(false, library).unknowns(), 3);
  BlockDefinition side = quiet_block(1);
  side.quiet[0].components = {false, false, true};
  EXPECT_EQ(BlockModel(side).unknowns(), 4 + 4 + 1);
}

TEST(QuietFaces, AWaveDrivesTwiceItsImpedanceInMotionOnly) {
  BlockDefinition definition = quiet_block(1);
  WaveVelocity velocity;
  velocity[0] = {{0.0, 1.0, 2.0}, {0.0, 0.5, 0.0}};
  velocity[2] = {{0.0, 1.0, 2.0}, {0.0, 0.25, 0.0}};
  velocity[1] = {{0.0, 2.0}, {0.0, 0.0}};
  definition.quiet[0].driving =
      wave_loads(*definition.solid, outer_faces(*definition.solid, base), soil, velocity);
  EXPECT_EQ(definition.quiet[0].driving.size(), 2U);
  const BlockModel held(definition);
  EXPECT_TRUE(held.load_force(1.0).isZero(0.0));
  EXPECT_FALSE(held.loads_change_between(0.2, 0.3));
  const BlockModel free = released(definition);
  const Vector3 force = std::sqrt(free.basis().volume()) * free.load_force(1.0).row(0).transpose();
  EXPECT_NEAR((force - Vector3(2 * across * 0.5 * 6, 0, 2 * along * 0.25 * 6)).norm(), 0.0, 1e-6 * along);
  EXPECT_TRUE(free.loads_change_between(0.2, 0.3));
  EXPECT_FALSE(free.loads_change_between(2.0, 3.0));
}

TEST(QuietFaces, AReactionBelongsToReleasedFaces) {
  const Eigen::MatrixX3d force = Eigen::MatrixX3d::Constant(4, 3, 5.0);
  BlockModel held(quiet_block(1));
  EXPECT_THROW(held.set_reaction(force), std::invalid_argument);
  BlockModel free = released(quiet_block(1));
  EXPECT_THROW(free.set_reaction(Eigen::MatrixX3d::Zero(10, 3)), std::invalid_argument);
  free.set_reaction(force);
  EXPECT_EQ(free.load_force(0.0), force);
  EXPECT_THROW((void)free.with_order(2), std::invalid_argument);
  EXPECT_EQ(held.with_order(2).unknowns(), 3 * (10 - 6));
}

TEST(QuietFaces, BlocksThatCannotHaveThemAreRefused) {
  BlockDefinition rigid = quiet_block(0);
  EXPECT_THROW(BlockModel{rigid}, std::invalid_argument);
  BlockDefinition driven = quiet_block();
  driven.supports.push_back({Plane{{0, 0, 0}, Vector3::UnitX()},
                             {true, true, true},
                             {{0.0, 1.0}, {Vector3::Zero(), Vector3::UnitX()}}});
  EXPECT_THROW(BlockModel{driven}, std::invalid_argument);
  BlockDefinition incremental = quiet_block();
  incremental.formulation = Formulation::incremental;
  EXPECT_THROW(BlockModel{incremental}, std::invalid_argument);
  BlockDefinition off = quiet_block();
  off.quiet[0].where = Plane{{0, 0, 0.5}, Vector3::UnitZ()};
  EXPECT_THROW(BlockModel{off}, std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::quiet_faces_test

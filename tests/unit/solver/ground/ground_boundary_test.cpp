#include "solver/ground/ground_boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/solid/shapes.hpp"

namespace ashlar::ground_boundary_test {
namespace {

using Held = std::array<bool, 3>;

/// lambda = mu = 8e7 Pa, c_s = 200 m/s.
const Material soil{2000.0, 2e8, 0.25};
const Vector3 gravity(0, 0, -10);
/// Along x with 0.1 m/s, along z with 0.2 m/s.
const GroundWave wave{{0.0, 0.05, 0.1}, {Vector3::Zero(), {0.1, 0, 0.2}, Vector3::Zero()}};

GroundBoundary base_with(const GroundWave& of_base) {
  return {{{0, 0, 0}, -Vector3::UnitZ()}, GroundBoundary::Kind::quiet, of_base};
}

GroundBoundary free_field_side() {
  return {{{6, 0, 0}, Vector3::UnitX()}, GroundBoundary::Kind::free_field};
}

TEST(GroundBoundary, ABaseIsHeldCompletelyAndASideAlongItsNormal) {
  EXPECT_EQ(held_components({0, 0, -2}, gravity), (Held{true, true, true}));
  EXPECT_EQ(held_components({3, 0, 0}, gravity), (Held{true, false, false}));
  EXPECT_EQ(held_components({0, -1, 0}, gravity), (Held{false, true, false}));
  EXPECT_EQ(held_components({1, 1, 0}, gravity), (Held{true, true, true}));
  EXPECT_EQ(held_components({3, 0, 0}, Vector3::Zero()), (Held{true, true, true}));
}

TEST(GroundBoundary, TheBaseOfASideIsTheQuietOneWithAWave) {
  const GroundBoundary side = free_field_side();
  EXPECT_EQ(base_of_side({base_with({}), base_with(wave), side}, 2), 1U);
  EXPECT_EQ(base_of_side({base_with({}), base_with({}), side}, 2), 0U);
  EXPECT_FALSE(base_of_side({side}, 0));
  const GroundBoundary parallel{{{0, 0, 0}, -Vector3::UnitX()}, GroundBoundary::Kind::quiet, wave};
  EXPECT_FALSE(base_of_side({parallel, side}, 1));
}

// A dashpot of the impedance rho c reflects nothing: (Z - rho c) / (Z + rho c) = 0. The wave then needs the traction
// 2 rho c w, half of it for the dashpots.
TEST(GroundBoundary, ABaseHasTheImpedanceOfItsMaterial) {
  const Polyhedron box(make_box({0, 0, 0}, {6, 2, 4}));
  const auto faces = quiet_faces_of(base_with(wave), {}, box, soil, gravity);
  ASSERT_TRUE(faces);
  const double shear = 2000.0 * 200.0, pressure = shear * std::sqrt(3.0);
  EXPECT_TRUE(impedance(soil, Vector3::UnitZ())
                  .isApprox(Eigen::Vector3d(shear, shear, pressure).asDiagonal().toDenseMatrix(), 1e-12));
  ASSERT_EQ(faces->driving.size(), 2U);
  EXPECT_NEAR((faces->driving[0].vector - Vector3(2.0 * shear, 0, 0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((faces->driving[1].vector - Vector3(0, 0, 2.0 * pressure)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(faces->driving[0].history.at(0.025), 0.05, 1e-15);
  EXPECT_NEAR(faces->driving[1].history.at(0.05), 0.2, 1e-15);
  EXPECT_EQ(faces->components, (Held{true, true, true}));
}

TEST(GroundBoundary, FacesElsewhereAreNotQuiet) {
  const Polyhedron above(make_box({0, 0, 4}, {6, 2, 8})), below(make_box({0, 0, -4}, {6, 2, 0}));
  EXPECT_FALSE(quiet_faces_of(base_with(wave), {}, above, soil, gravity));
  EXPECT_FALSE(quiet_faces_of(base_with(wave), {}, below, soil, gravity));
}

TEST(GroundBoundary, AColumnDrivesTheFacesBesideIt) {
  const Polyhedron box(make_box({0, 0, 0}, {6, 2, 4}));
  SideColumn column;
  column.column = std::make_shared<const FreeFieldColumn>(std::vector<GroundLayer>{{0.0, 4.0, soil, 1}});
  column.times = {0.0};
  column.displacement = {Eigen::MatrixX3d::Zero(2, 3)};
  column.velocity = {Eigen::MatrixX3d::Constant(2, 3, 0.1)};
  const auto faces = quiet_faces_of(free_field_side(), column, box, soil, gravity);
  ASSERT_TRUE(faces);
  EXPECT_EQ(faces->driving.size(), 6U);  // two nodes, three components
  EXPECT_EQ(faces->components, (Held{true, false, false}));
  EXPECT_TRUE(quiet_faces_of(free_field_side(), {}, box, soil, gravity)->driving.empty());
}

}  // namespace
}  // namespace ashlar::ground_boundary_test

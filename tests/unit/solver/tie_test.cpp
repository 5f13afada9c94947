// Tied blocks act as one body: in statics, in motion, turned, with orders that differ.
#include "mechanics/contact/laws/tie.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/simulations.hpp"

namespace ashlar::tie_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

Simulation chain(std::vector<BlockDefinition> definitions, const std::vector<InitialMotion>& motions,
                 const SimulationSettings& settings, double stiffness) {
  std::vector<BlockModel> blocks;
  blocks.reserve(definitions.size());
  for (BlockDefinition& definition : definitions) blocks.emplace_back(std::move(definition));
  const int count = static_cast<int>(blocks.size());
  std::vector<TieRequest> ties;
  for (int k = 0; k + 1 < count; ++k) ties.push_back({k, k + 1, stiffness});
  Simulation simulation(std::move(blocks), motions, same_law({1e9, 1e9, 0.5, 0.0, 0.0, true}), settings,
                        ties);
  EXPECT_EQ(simulation.system().ties().size(), ties.size());
  return simulation;
}

TEST(Tie, SquaredGapIsThatOfTheCommonPartOfTheFaces) {
  // Faces [0,2] x [0,1] at z = 1 from below and [1,3] x [0,1] from above: 1 m^2 in common, from x = 1 to 2.
  const Polyhedron lower(make_box({0, 0, 0}, {2, 1, 1})), upper(make_box({1, 0, 1}, {3, 1, 2}));
  const PolynomialBasis below(lower, 2), above(upper, 3);
  const Tie tie = tie_between(lower, below, upper, above);
  EXPECT_NEAR(tie.area, 1.0, 1e-14);
  EXPECT_NEAR((tie.a * below.identity_map() - tie.b * above.identity_map()).norm(), 0.0, 1e-13);
  // Lower block moved by u_z = x: integral of x^2 from 1 to 2 is 7/3.
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(2, 0) = 1.0;
  const Vector3 at_centroid = gradient * below.centroid();
  const double squared = (tie.a * below.linear_field(at_centroid, gradient)).squaredNorm();
  EXPECT_NEAR(squared, 7.0 / 3.0, 1e-12);
}

TEST(Tie, RoundedCornersLoseNothing) {
  // The diagonals of both faces almost lie on each other; what they cut off has no area but rounding.
  std::mt19937_64 random(20261122);
  const auto jittered = [&](const Vector3& low, const Vector3& high) {
    TriangleMesh box = make_box(low, high);
    for (Vector3& point : box.points) {
      for (double& x : point) x += 0x1p-52 * static_cast<double>(static_cast<int>(random() % 3) - 1);
    }
    return Polyhedron(box, 0x1p-46);
  };
  for (int trial = 0; trial < 300; ++trial) {
    const Polyhedron lower = jittered({0, 0, 0}, {1.7, 1.1, 1}), upper = jittered({0, 0, 1}, {1.7, 1.1, 2});
    const PolynomialBasis below(lower, 2), above(upper, 2);
    const Tie tie = tie_between(lower, below, upper, above);
    EXPECT_NEAR(tie.area, 1.87, 1e-13);
    // The squared gap of a block moved by 1 m along z is the area.
    const Eigen::VectorXd ones = (tie.a * below.linear_field({0, 0, 1}, Eigen::Matrix3d::Zero())).col(2);
    ASSERT_NEAR(ones.squaredNorm(), 1.87, 1e-12) << trial;
    ASSERT_EQ(tie.a.rows(), 6) << trial;  // 1, x, y, x^2, x y, y^2
  }
}

TEST(Tie, BlocksThatMeetInAnEdgeHaveNoCommonFace) {
  const Polyhedron a(make_box({0, 0, 0}, {1, 1, 1})), b(make_box({1, 1, 0}, {2, 2, 1}));
  const PolynomialBasis of_a(a, 1), of_b(b, 1);
  EXPECT_EQ(tie_between(a, of_a, b, of_b).area, 0.0);
  EXPECT_EQ(tie_between(a, of_a, b, of_b).a.rows(), 0);
}

TEST(Tie, ChainComesNearerThanOneBlockOfHighOrder) {
  // 8 x 3 x 1 cantilever under its own weight; the tip goes down by 2.7131353e-3 m when the order goes on
  // rising.
  const double tip = -2.7131353e-3;
  const Material rock{3600, 1e10, 0.2};
  const Plane root{{0, 0, 0}, {1, 0, 0}};
  BlockDefinition whole = block_of("whole", Polyhedron(make_box({0, -0.5, -1.5}, {8, 0.5, 1.5})), rock, 8);
  whole.supports.push_back({root});
  const BlockModel one(std::move(whole));
  const Eigen::MatrixX3d rest = *one.equilibrium({0, 0, -9.81}, 0.0) - one.basis().identity_map();
  const double of_one = (rest.transpose() * one.basis().values(Vector3(8, 0, 0))).z();

  std::vector<BlockDefinition> parts;
  parts.reserve(4);
  for (int k = 0; k < 4; ++k) {
    parts.push_back(
        block_of("part", Polyhedron(make_box({2.0 * k, -0.5, -1.5}, {2.0 * k + 2.0, 0.5, 1.5})), rock, 5));
  }
  parts[0].supports.push_back({root});
  Simulation simulation = chain(std::move(parts), std::vector<InitialMotion>(4), {}, 1e5 * 1e10 / 2.0);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  ASSERT_EQ(status, StaticStatus::equilibrium);
  const double of_chain = place_of(simulation, 3, {8, 0, 0}).z();
  EXPECT_LT(std::abs(of_chain - tip), std::abs(of_one - tip));
  EXPECT_LT(std::abs(of_chain - tip), 5e-3 * std::abs(tip));
}

TEST(Tie, ChainsHeldByASupportNeedNoInertiaInStatics) {
  const Material rock{3600, 1e9, 0.0};
  std::vector<BlockDefinition> parts;
  parts.reserve(6);
  for (int k = 0; k < 6; ++k) {
    parts.push_back(block_of(
        "part", Polyhedron(make_box({1.0 * k, -0.05, -0.05}, {1.0 * k + 1.0, 0.05, 0.05})), rock, 3));
  }
  parts[0].supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  // Down by F L^3 / (3 E I) = 0.0864 m.
  parts[5].loads.push_back({Plane{{6, 0, 0}, {1, 0, 0}}, false, Vector3(0, 0, -10.0), {{0, 1}, {0, 1}}});
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.time_step = 0.1;
  Simulation simulation = chain(std::move(parts), std::vector<InitialMotion>(6), settings, 1e5 * 1e9);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  ASSERT_EQ(status, StaticStatus::equilibrium);
  EXPECT_NEAR(place_of(simulation, 5, {6, 0, 0}).z(), -0.0864, 2e-4);
  // The first of ten levels gives up inertia, the others are Newton's.
  EXPECT_LE(simulation.steps(), 50);
}

TEST(Tie, FreeChainSpinsAsOneBody) {
  const Material stiff{2000, 1e9, 0.2};
  const Vector3 spin(0, 0, 1);
  std::vector<BlockDefinition> parts;
  std::vector<InitialMotion> motions;
  for (const auto& [from, order] : {std::pair{-1.5, 1}, {-0.5, 2}, {0.5, 1}}) {
    parts.push_back(
        block_of("part", Polyhedron(make_box({from, -0.5, -0.5}, {from + 1.0, 0.5, 0.5})), stiff, order));
    motions.push_back({spin.cross(Vector3(from + 0.5, 0, 0)), spin});
  }
  SimulationSettings settings;
  settings.integrator = Integrator::average_acceleration;
  settings.gravity.setZero();
  settings.time_step = 0.01;
  Simulation simulation = chain(std::move(parts), motions, settings, 1e5 * 1e9);
  const Vector3 angular_momentum = simulation.angular_momentum();
  const double energy = simulation.ledger().kinetic;
  ASSERT_TRUE(run_until(simulation, 2.0));
  EXPECT_TRUE(simulation.rejections().empty());
  EXPECT_LT((simulation.angular_momentum() - angular_momentum).norm(), 1e-6 * angular_momentum.norm());
  EXPECT_LT(simulation.momentum().norm(), 1e-9 * 6000.0);
  EXPECT_LT(simulation.largest_step_residual(), 1e-7 * energy);
  EXPECT_EQ(simulation.ledger().redetection_energy(), 0.0);
  // Both ends still in one line through the middle, at their distance but for the stretch rho w^2 l^2 / E.
  const Vector3 one = place_of(simulation, 0, {-1.5, 0, 0}), other = place_of(simulation, 2, {1.5, 0, 0});
  EXPECT_LT((one + other).norm(), 1e-6);
  EXPECT_NEAR((other - one).norm(), 3.0, 1e-3);
  const Vector3 corner(-0.5, 0.5, 0.5);
  EXPECT_LT((place_of(simulation, 0, corner) - place_of(simulation, 1, corner)).norm(), 1e-8);
}

TEST(Tie, HoldsABlockToAFixedOne) {
  BlockDefinition wall = block_of("wall", Polyhedron(make_box({-1, -1, -1}, {0, 1, 1})), {}, 1);
  wall.fixed = true;
  const BlockDefinition arm =
      block_of("arm", Polyhedron(make_box({0, -0.5, -0.5}, {2, 0.5, 0.5})), {2500, 1e9, 0.0}, 1);
  SimulationSettings settings;
  settings.gravity = {9.81, 0, 0};
  Simulation simulation = chain({wall, arm}, std::vector<InitialMotion>(2), settings, 1e14);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
  ASSERT_EQ(status, StaticStatus::equilibrium);
  // A block of order 1, pulled by its weight rho g V at the centroid: strain rho g (L/2)/E.
  EXPECT_NEAR(place_of(simulation, 1, {2, 0, 0}).x() - 2.0, 2500 * 9.81 * 1.0 / 1e9 * 2.0, 1e-8);
  // Compression of the joint: m g / (k A).
  EXPECT_NEAR(place_of(simulation, 1, {0, 0, 0}).x() / (2500 * 2 * 9.81 / 1e14), 1.0, 1e-3);
}

// The static state has energy in the springs of the tie, which a motion from it must not count as gained.
TEST(Tie, MotionFromStaticsBeginsWithItsEnergy) {
  BlockDefinition base = block_of("base", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), {2500, 1e7, 0.2}, 2);
  base.supports.push_back({Plane{{0, 0, 0}, -Vector3::UnitZ()}});
  BlockDefinition top = block_of("top", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), {2500, 1e7, 0.2}, 2);
  Simulation simulation = chain({base, top}, {{}, {}}, SimulationSettings{}, 1e8);
  ASSERT_EQ(simulation.start_from_statics(), StaticStatus::equilibrium);
  ASSERT_TRUE(run_until(simulation, 0.01));
  // Mean force 25 kN, stiffness 1e8 N/m: some 3 J.
  EXPECT_GT(simulation.ledger().contact, 1.0);
  EXPECT_LT(std::abs(simulation.ledger().residual), 1e-9 * simulation.ledger().contact);
}

}  // namespace
}  // namespace ashlar::tie_test

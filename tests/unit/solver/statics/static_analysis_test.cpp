// Static analyses whose answer statics gives: equilibrium, sliding, nothing that holds.
#include "solver/statics/static_analysis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::same_law;
using test_support::tilted_box;

const Material rock{2700.0, 1e10, 0.2};

template <class... Definitions>
std::vector<BlockModel> models(Definitions... definitions) {
  std::vector<BlockModel> result;
  (result.emplace_back(std::move(definitions)), ...);
  return result;
}

BlockDefinition fixed_block(Polyhedron solid) {
  BlockDefinition block = block_of("base", std::move(solid), rock, 1);
  block.fixed = true;
  return block;
}

StaticStatus run_static(Simulation& simulation, double end_time) {
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(end_time);
  return status;
}

BlockDefinition cantilever(int order) {
  BlockDefinition block =
      block_of("B", Polyhedron(make_box({0, -1.5, -0.5}, {8, 1.5, 0.5})), {3600.0, 1e9, 0.2}, order);
  block.supports.push_back({Plane{{0, 0, 0}, {1, 0, 0}}});
  return block;
}

TEST(StaticAnalysis, ABeamThatIsLiftedAtOneEndComesToRest) {
  // 3 x 1 x 0.3 m, half its weight is 11 kN. Cuts where pressure ends came and went: iterations went to and
  // fro.
  for (const int order : {2, 3}) {
    for (const double lift : {7e3, 8e3, 1.05e4}) {
      BlockDefinition beam =
          block_of("beam", Polyhedron(make_box({-1.5, -0.5, 0}, {1.5, 0.5, 0.3})), {2500, 1e9, 0.2}, order);
      beam.supports.push_back({Vector3(-1.5, 0, 0), {true, true, false}, {}});
      beam.loads.push_back({Plane{{1.5, 0, 0}, {1, 0, 0}}, false, Vector3(0, 0, lift), {}});
      SimulationSettings settings;
      settings.time_step = 1e-3;
      settings.contact_distance = 1e-3;
      settings.search.subdivisions = 0;
      settings.search.chord_tolerance = 4.8e-3;
      Simulation simulation(models(fixed_box({-3, -3, -1}, {3, 3, 0}), std::move(beam)), {{}, {}},
                            same_law({2.07e10, 1e10, 0.0, 0.0, 0.0, true}), settings);
      EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium) << order << " " << lift;
      EXPECT_LT(simulation.steps(), 30U);
    }
  }
}

/// A plank 3 m long and 5 cm thick that bends over the ends of a fixed shelf, 1 m wide. @return how far its
/// middle and its tip go up
Eigen::Vector2d plank_on_shelf(double thickness, bool area_springs) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.search.subdivisions = area_springs ? 0 : 1;
  settings.area_springs = area_springs;
  settings.contact_distance = 5e-4;
  settings.search.chord_tolerance = 2.7e-3;
  const double stiffness = area_springs ? 4e9 : 1e9;
  Simulation simulation(models(fixed_box({-0.5, -1, -thickness}, {0.5, 1, 0}),
                               block_of("plank", Polyhedron(make_box({-1.5, -0.5, 0}, {1.5, 0.5, 0.05})),
                                        {2500.0, 1.2e8, 0.2}, 2)),
                        {{}, {}}, same_law({stiffness, stiffness, 0.577, 0.0, 0.0, area_springs}), settings);
  EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  EXPECT_LT(simulation.report().penetration, 5e-3);
  return {place_of(simulation, 1, {0, 0, 0}).z(), place_of(simulation, 1, {1.5, 0, 0}).z()};
}

TEST(StaticAnalysis, APlankDoesNotMindHowThickItsShelfIs) {
  // A thin one was taken to touch the plank's upper side from below, through both: the plank lay 2.7 cm in
  // it.
  for (const bool area_springs : {true, false}) {
    const Eigen::Vector2d thick = plank_on_shelf(1.0, area_springs);
    EXPECT_GT(thick[0], 0.0);
    EXPECT_LT(thick[1], -0.2);
    for (const double thickness : {0.1, 0.01})
      EXPECT_LT((plank_on_shelf(thickness, area_springs) - thick).norm(), 1e-6) << thickness;
  }
}

TEST(StaticAnalysis, CantileverComesToItsEquilibrium) {
  for (const int order : {1, 3, 6}) {
    for (const double time_step : {1e-4, 1.0}) {
      SimulationSettings settings;
      settings.time_step = time_step;
      Simulation simulation(models(cantilever(order)), {{}}, same_law({}), settings);
      ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
      const Eigen::MatrixX3d expected = *simulation.blocks()[0].equilibrium(settings.gravity, 1.0);
      const Eigen::MatrixX3d reference = simulation.blocks()[0].basis().identity_map();
      EXPECT_LT((simulation.states()[0].position - expected).norm(), 1e-9 * (expected - reference).norm());
      EXPECT_TRUE(simulation.states()[0].velocity.isZero(0.0));
      EXPECT_LT(simulation.steps(), 40);
      EXPECT_LT(std::abs(simulation.ledger().residual), 1e-8 * simulation.ledger().elastic);
    }
  }
}

TEST(StaticAnalysis, CubeRestsOnItsBase) {
  for (const int order : {1, 2}) {
    SimulationSettings settings;
    settings.search.subdivisions = 1;
    Simulation simulation(models(block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, order),
                                 fixed_block(Polyhedron(make_box({-2, -2, -1}, {3, 3, 0})))),
                          {{}, {}}, same_law({1e10, 5e9, 0.5, 0.0, 0.0, true}), settings);
    EXPECT_TRUE(simulation.loose_blocks().empty());
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
    Vector3 force = Vector3::Zero();
    for (std::size_t k = 0; k < simulation.contacts()[0].points.size(); ++k) {
      const ContactPoint& point = simulation.contacts()[0].points[k];
      const Eigen::Vector3d& parts = simulation.contacts()[0].responses[k].force;
      force += parts[0] * point.normal + parts[1] * point.tangent_1 + parts[2] * point.tangent_2;
    }
    EXPECT_LT((force - Vector3(0, 0, 2700.0 * 9.81)).norm(), 1e-8 * 2700.0 * 9.81);
    // The pressure is rho g and the springs give way by rho g / kn, but for the base that grows by Poisson's
    // ratio times rho g / (2 E), here 2.6e-7, in both directions.
    if (order == 1) {
      EXPECT_NEAR(simulation.largest_penetration() / (2700.0 * 9.81 / 1e10), 1.0, 1e-6);
    }
  }
}

Simulation on_incline(double incline, double friction_angle, int order = 1) {
  JointLaw law{1e10, 1e10, std::tan(friction_angle * std::numbers::pi / 180.0), 0.0, 0.0, true};
  return Simulation(models(block_of("A", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, incline), rock, order),
                           fixed_block(tilted_box({-6, -2, -1}, {2, 2, 0}, incline))),
                    {{}, {}}, same_law(law), {});
}

TEST(StaticAnalysis, BlockSticksOnAnIncline) {
  Simulation simulation = on_incline(30, 31);
  const Vector3 start = place_of(simulation, 0, {0, 0, 0});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  EXPECT_TRUE(simulation.moving_blocks().empty());
  // The springs of 1e10 N/m carry m g: what the block gives way is of the size of m g / k.
  EXPECT_LT((place_of(simulation, 0, {0, 0, 0}) - start).norm(), 10.0 * 2700.0 * 9.81 / 1e10);
}

TEST(StaticAnalysis, BlockSlidesOnAnIncline) {
  for (const double friction_angle : {0.0, 20.0, 29.0}) {
    Simulation simulation = on_incline(30, friction_angle);
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
    const auto moving = simulation.moving_blocks();
    ASSERT_EQ(moving.size(), 1U);
    EXPECT_EQ(moving[0].block, 0);
    // a = g (sin 30 - cos 30 tan phi) down the slope, which goes down towards -x
    const double degree = std::numbers::pi / 180.0;
    const double size = 9.81 * (0.5 - std::cos(30 * degree) * std::tan(friction_angle * degree));
    const Vector3 expected = size * Vector3(-std::cos(30 * degree), 0, -0.5);
    EXPECT_LT((moving[0].acceleration - expected).norm(), 1e-3 * size) << moving[0].acceleration.transpose();
    EXPECT_EQ(simulation.static_step(1.0), StaticStatus::moving);
  }
}

TEST(StaticAnalysis, AccelerationsOfABlockThatWasInBalanceAreThoseAfterIt) {
  // Friction holds the block until an iteration lacks nothing; then there is less of it.
  Simulation held = on_incline(30, 31);
  while (held.snapshot().run.statics.still_iterations == 0)
    ASSERT_EQ(held.static_step(1.0), StaticStatus::balancing);
  Simulation released = on_incline(30, 20);
  released.restore(held.snapshot());
  ASSERT_EQ(run_static(released, 1.0), StaticStatus::moving);
  ASSERT_EQ(released.moving_blocks().size(), 1U);
  const double degree = std::numbers::pi / 180.0;
  const double size = 9.81 * (0.5 - std::cos(30 * degree) * std::tan(20 * degree));
  EXPECT_NEAR(released.moving_blocks()[0].acceleration.norm(), size, 1e-3 * size);
}

TEST(StaticAnalysis, SlowSlidingIsMovingToo) {
  // Just below the limit of friction, a block of high order covers a hundredth of its size in an iteration.
  Simulation simulation = on_incline(10, 9.95, 3);
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const double degree = std::numbers::pi / 180.0;
  const double size = 9.81 * (std::sin(10 * degree) - std::cos(10 * degree) * std::tan(9.95 * degree));
  ASSERT_EQ(simulation.moving_blocks().size(), 1U);
  EXPECT_NEAR(simulation.moving_blocks()[0].acceleration.norm() / size, 1.0, 1e-2);
}

/// Angular acceleration about y of a block of base 1 and height 3 on an incline of 30 degrees: the weight
/// acts outside the base, as tan 30 > 1/3.
double toppling(double stiffness) {
  const JointLaw law{stiffness, stiffness, std::tan(50 * std::numbers::pi / 180.0), 0.0, 0.0, true};
  Simulation simulation(models(block_of("A", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 3}, 30), rock, 1),
                               fixed_block(tilted_box({-6, -2, -1}, {2, 2, 0}, 30))),
                        {{}, {}}, same_law(law), {});
  EXPECT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  EXPECT_EQ(moving.size(), 1U);
  return moving.empty() ? 0.0 : moving[0].angular_acceleration.y();
}

TEST(StaticAnalysis, TallBlockTopples) {
  // It turns over its lower edge, from +z towards -x, about -y, as it starts to: m g (H/2 sin - D/2 cos) over
  // m (D^2 + H^2)/3, if the joint is so stiff that what is pressed is an edge. Else N = 67 kN press a strip
  // of width w = sqrt(2 N / (k theta)), and it turns over a line w/3 farther in, faster by w/3 of the
  // weight's arm of 0.317 m: at theta = 6e-4 by 5 % with 1e11 Pa/m, by 0.5 % with 1e13.
  const double expected = 9.81 * (1.5 * 0.5 - 0.5 * std::sqrt(0.75)) / (10.0 / 3.0);
  const auto excess = [&](double stiffness) { return toppling(stiffness) / -expected - 1.0; };
  const double soft = excess(1e11);
  const double stiff = excess(1e13);
  const double stiffest = excess(1e15);
  EXPECT_LT(soft, 0.05);
  EXPECT_LT(stiff, 0.01);
  EXPECT_LT(stiffest, 0.002);
  EXPECT_GT(soft, stiff);
  EXPECT_GT(stiff, stiffest);
  EXPECT_GT(stiffest, 0.0);
}

/// A wall of 0.5 x 3 x 2 m and 2000 kg/m3 that is pushed at half its height. @param push N
StaticStatus pushed_wall(double push, int order) {
  BlockDefinition wall =
      block_of("wall", Polyhedron(make_box({0, -1.5, 0}, {0.5, 1.5, 2})), {2000, 1e11, 0.2}, order);
  wall.loads.push_back({Plane{{0, 0, 0}, {-1, 0, 0}}, false, {push, 0, 0}, {}});
  Simulation simulation(models(std::move(wall), fixed_block(Polyhedron(make_box({-3, -3, -1}, {3, 3, 0})))),
                        {{}, {}},
                        same_law({1e9, 1e9, std::tan(40 * std::numbers::pi / 180.0), 0.0, 0.0, true}), {});
  return run_static(simulation, 1.0);
}

// A joint without tension under a rigid wall of weight N: turned by t it is pressed over c, N = kn t c^2 w/2,
// and F h = N (b/2 - c/3 - t h) with h = 1 m. The largest F is at t^(3/2) = sqrt(2 N/(kn w))/6 = 1.044e-3:
// t = 0.01029, c = 0.0617 m, F = 12.90 kN; with all of N on the edge it would be 14.7 kN.
TEST(StaticAnalysis, AWallTurnsOverWhereItsJointIsPressed) {
  for (const int order : {1, 2, 3}) {
    EXPECT_EQ(pushed_wall(12800.0, order), StaticStatus::equilibrium) << order;
    EXPECT_EQ(pushed_wall(13000.0, order), StaticStatus::moving) << order;
  }
}

/// A prism along y over a square on its corner, its lower edge from the origin on.
BlockDefinition standing_prism(double length) {
  std::vector<Vector3> points;
  for (const double y : {0.0, length}) {
    points.insert(points.end(), {{0, y, 0}, {1, y, 1}, {0, y, 2}, {-1, y, 1}});
  }
  return block_of("A", Polyhedron(make_convex_hull(points)), rock, 1);
}

TEST(StaticAnalysis, AnEdgeThatJustTouchesAFaceIsHeld) {
  // The weight acts through the edge: no friction is needed. The face is wider, as long or shorter.
  const std::vector<std::pair<double, Polyhedron>> cases = {
      {1.0, Polyhedron(make_box({-4, -1, -1}, {4, 2, 0}))},
      {1.0, Polyhedron(make_box({-4, 0, -1}, {4, 1, 0}))},
      {3.0, Polyhedron(make_box({-4, 1, -1}, {4, 2, 0}))},
  };
  for (const auto& [length, base] : cases) {
    Simulation simulation(models(standing_prism(length), fixed_block(base)), {{}, {}},
                          same_law({1e10, 5e9, 0.0, 0.0, 0.0, true}), {});
    EXPECT_TRUE(simulation.loose_blocks().empty());
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
    double force = 0.0;
    for (const PairRecord& pair : simulation.contacts())
      for (std::size_t k = 0; k < pair.points.size(); ++k)
        force += pair.responses[k].force[0] * pair.points[k].normal.z();
    // The square has an area of 2.
    const double weight = 2.0 * length * 2700.0 * 9.81;
    EXPECT_NEAR(force, weight, 1e-8 * weight);
  }
}

TEST(StaticAnalysis, AnEdgeThatJustTouchesAnEdgeIsNotWithoutContact) {
  // Over the rim of its base: nothing but the rim is below, from which it may come off.
  Simulation simulation(
      models(standing_prism(1.0), fixed_block(Polyhedron(make_box({-2, -1, -1}, {0, 2, 0})))), {{}, {}},
      same_law({1e10, 5e9, 0.5, 0.0, 0.0, true}), {});
  EXPECT_TRUE(simulation.loose_blocks().empty());
  EXPECT_NE(run_static(simulation, 1.0), StaticStatus::not_converged);
}

/// A prism over a profile in x and z, y from 0 to 1.
Polyhedron upright_prism(const std::vector<std::array<double, 2>>& profile) {
  std::vector<Vector3> points;
  for (const auto& [x, z] : profile) points.insert(points.end(), {Vector3(x, 0, z), Vector3(x, 1, z)});
  return Polyhedron(make_convex_hull(points));
}

TEST(StaticAnalysis, PlanksThatSlideApartAreNotFollowedInSmallSteps) {
  // Edges that slide down on each other are found anew in each iteration, which took 500 of them.
  const double friction = std::tan(10.0 * std::numbers::pi / 180.0);
  Simulation simulation(
      models(block_of("left", upright_prism({{-2, 0}, {-1.8, 0}, {0, 1.6}, {0, 1.8}}), rock, 1),
             block_of("right", upright_prism({{2, 0}, {1.8, 0}, {0, 1.6}, {0, 1.8}}), rock, 1),
             fixed_box({-6, -2, -1}, {6, 2, 0})),
      {{}, {}, {}}, same_law({2e11, 1e11, friction, 0.0, 0.0, true}), {});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  EXPECT_LE(simulation.steps(), 100);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_EQ(moving.size(), 2U);
  EXPECT_LT(moving[0].acceleration.x(), -0.1);
  EXPECT_NEAR(moving[0].acceleration.x(), -moving[1].acceleration.x(), 1e-3);
  EXPECT_NEAR(moving[0].acceleration.z(), moving[1].acceleration.z(), 1e-3);
}

TEST(StaticAnalysis, PlanksThatSlideApartAsTheyFallAreMovingThoughTheyMeetOnEdges) {
  // Two planks lean on each other. They turn flatter about their inner lower and upper corners at f and a
  // from their centroids; these slide on the floor with friction m and stay on the mirror plane:
  //   w (I + za^2 - xf (m (zf - za) - xf)) = g (m (zf - za) - xf),   I the unit inertia.
  // When they have fallen far only two edges meet, and iterations do not go on.
  const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d{-1, 0}, {-0.85, 0}, {0, 1}, {0, 1.25}};
  double area = 0.0;
  double squares = 0.0;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d& p = corners[k];
    const Eigen::Vector2d& q = corners[(k + 1) % 4];
    const double twice = p.x() * q.y() - p.y() * q.x();
    area += twice / 2.0;
    centroid += twice / 6.0 * (p + q);
    squares += twice / 12.0 * (p.dot(p) + p.dot(q) + q.dot(q));
  }
  centroid /= area;
  const Eigen::Vector2d foot = corners[1] - centroid;
  const Eigen::Vector2d top = corners[3] - centroid;
  const double friction = std::tan(12.0 * std::numbers::pi / 180.0);
  const double lever = friction * (foot.y() - top.y()) - foot.x();
  const double turn =
      9.81 * lever / (squares / area - centroid.squaredNorm() + top.y() * top.y() - foot.x() * lever);
  std::vector<BlockDefinition> planks;
  for (const double side : {1.0, -1.0}) {
    std::vector<Vector3> points;
    for (const Eigen::Vector2d& corner : corners)
      for (const double y : {-0.4, 0.4}) points.emplace_back(side * corner.x(), y, corner.y());
    planks.push_back(block_of("plank", Polyhedron(make_convex_hull(points)), {2500, 1e10, 0.2}, 1));
  }
  SimulationSettings settings;
  settings.augmented = true;
  settings.contact_distance = 1e-4;
  settings.multipliers.penetration_tolerance = 1e-7;
  Simulation simulation(
      models(planks[0], planks[1], fixed_block(Polyhedron(make_box({-5, -0.6, -1}, {5, 0.6, 0})))),
      {{}, {}, {}}, same_law({2e11, 1e11, friction, 0.0, 0.0, true}), settings);
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_EQ(moving.size(), 2U);
  for (const std::size_t k : {0U, 1U}) {
    const double side = k == 0 ? 1.0 : -1.0;
    EXPECT_NEAR(moving[k].angular_acceleration.y(), side * turn, 1e-3 * turn);
    EXPECT_NEAR(moving[k].acceleration.x(), -side * turn * top.y(), 1e-3 * turn);
    EXPECT_NEAR(moving[k].acceleration.z(), turn * foot.x(), 1e-3 * turn);
  }
}

TEST(StaticAnalysis, WhatMovesLittleIsNamedToo) {
  // A slender wedge sinks between two blocks that it drives apart by a twentieth of its way: frictionless,
  // (m + 2 M tan^2) a = m g with the masses m of the wedge and M of each of the two.
  const double tangent = 0.05;
  const Polyhedron wedge = upright_prism({{0, 1}, {tangent, 2}, {-tangent, 2}});
  const Polyhedron left = upright_prism({{-1, 0}, {0, 0}, {0, 1}, {-tangent, 2}, {-1, 2}});
  const Polyhedron right = upright_prism({{0, 0}, {1, 0}, {1, 2}, {tangent, 2}, {0, 1}});
  Simulation simulation(models(block_of("wedge", wedge, rock, 1), block_of("left", left, rock, 1),
                               block_of("right", right, rock, 1), fixed_box({-4, -2, -1}, {4, 2, 0})),
                        {{}, {}, {}, {}}, same_law({1e11, 5e10, 0.0, 0.0, 0.0, true}), {});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::moving);
  const std::vector<MovingBlock> moving = simulation.moving_blocks();
  ASSERT_EQ(moving.size(), 3U);
  const double other = 2.0 - 0.5 * tangent;  // m^2
  const double size = 9.81 * tangent / (tangent + 2.0 * other * tangent * tangent);
  EXPECT_NEAR(moving[0].acceleration.z(), -size, 1e-3 * size);
  EXPECT_NEAR(moving[1].acceleration.x(), -tangent * size, 1e-3 * tangent * size);
  EXPECT_NEAR(moving[2].acceleration.x(), tangent * size, 1e-3 * tangent * size);
}

TEST(StaticAnalysis, SoftPlatesOnStiffPiersSettleWithMultipliers) {
  // Which forces the corners of the piers bear is settled far more slowly than how deep they are.
  for (const int order : {1, 3}) {
    BlockDefinition plate =
        block_of("plate", Polyhedron(make_box({-1, -1, 1}, {1, 1, 1.2})), {1000.0, 1e7, 0.3}, order);
    const auto pier = [](const std::string& name, double x, double y) {
      return block_of(name, Polyhedron(make_box({x - 0.1, y - 0.1, 0}, {x + 0.1, y + 0.1, 1})), rock, 1);
    };
    SimulationSettings settings;
    settings.augmented = true;
    settings.multipliers.penetration_tolerance = 3.4e-7;
    settings.contact_distance = 3.4e-4;
    Simulation simulation(models(plate, pier("A", 0, 0.8), pier("B", -0.7, -0.5), pier("C", 0.7, -0.5),
                                 fixed_box({-2, -2, -1}, {2, 2, 0})),
                          {{}, {}, {}, {}, {}},
                          same_law({2e8, 1e8, std::tan(std::numbers::pi / 6.0), 0.0, 0.0, true}), settings);
    ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium) << order;
    EXPECT_LE(simulation.steps(), 30) << order;
    EXPECT_LE(simulation.report().penetration, settings.multipliers.penetration_tolerance);
    double held = 0.0;
    for (const PairRecord& record : simulation.contacts()) {
      if (record.a == 0 || record.b == 0) held += (record.a == 0 ? 1.0 : -1.0) * force_on_a(record).z();
    }
    EXPECT_NEAR(held, 1000.0 * 0.8 * 9.81, 1e-6);
  }
}

TEST(StaticAnalysis, LevelsOfLoadsAreMultiplesOfTheStep) {
  BlockDefinition stone = block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1);
  Load push;
  push.where = Plane{{0, 0, 0}, {1, 0, 0}};
  push.vector = {0.1 * 2700 * 9.81, 0, 0};
  push.history = {{0.0, 1.0}, {0.0, 1.0}};
  stone.loads.push_back(push);
  SimulationSettings settings;
  settings.time_step = 0.1;
  Simulation simulation(models(std::move(stone), fixed_block(Polyhedron(make_box({-2, -2, -1}, {3, 3, 0})))),
                        {{}, {}}, same_law({1e10, 5e9, 0.5, 0.0, 0.0, true}), settings);
  std::vector<double> times;
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) {
    status = simulation.static_step(1.0);
    if (times.empty() || times.back() != simulation.time()) times.push_back(simulation.time());
  }
  EXPECT_EQ(status, StaticStatus::equilibrium);
  EXPECT_EQ(times, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}));
}

TEST(StaticAnalysis, LoadsThatChangeAreFollowed) {
  // A block pushed along its base by a tenth of its weight and let go again: friction 0.5 holds it all the
  // time.
  BlockDefinition stone = block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1);
  Load push;
  push.where = Plane{{0, 0, 0}, {1, 0, 0}};
  push.vector = {0.1 * 2700 * 9.81, 0, 0};
  push.history = {{0.0, 0.5, 1.0}, {0.0, 1.0, 0.0}};
  stone.loads.push_back(push);
  SimulationSettings settings;
  settings.time_step = 0.125;
  Simulation simulation(models(std::move(stone), fixed_block(Polyhedron(make_box({-2, -2, -1}, {3, 3, 0})))),
                        {{}, {}}, same_law({1e10, 5e9, 0.5, 0.0, 0.0, true}), settings);
  std::vector<double> times;
  StaticStatus status = StaticStatus::balancing;
  double most = 0.0;
  while (status == StaticStatus::balancing) {
    status = simulation.static_step(1.0);
    if (times.empty() || times.back() != simulation.time()) times.push_back(simulation.time());
    if (simulation.time() == 0.5) most = place_of(simulation, 0, {0.5, 0.5, 0.0}).x() - 0.5;
  }
  EXPECT_EQ(status, StaticStatus::equilibrium);
  EXPECT_EQ(times, (std::vector<double>{0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0}));
  // the springs have a stiffness of 5e9 N/m along the base
  EXPECT_NEAR(most / (0.1 * 2700 * 9.81 / 5e9), 1.0, 1e-5);
  EXPECT_NEAR(place_of(simulation, 0, {0.5, 0.5, 0.0}).x(), 0.5, 1e-9 * most + 1e-12);
}

TEST(StaticAnalysis, GoesOnFromASnapshotBitForBit) {
  struct Case {
    double incline, friction_angle;
    int before;  ///< iterations
    StaticStatus end;
  };
  // Motion is known after a few iterations, balance is not.
  for (const Case& of : {Case{30, 20, 2, StaticStatus::moving}, Case{20, 30, 5, StaticStatus::equilibrium}}) {
    const auto make = [&] { return on_incline(of.incline, of.friction_angle); };
    Simulation whole = make();
    Simulation part = make();
    for (int k = 0; k < of.before; ++k) {
      EXPECT_EQ(whole.static_step(1.0), StaticStatus::balancing);
      EXPECT_EQ(part.static_step(1.0), StaticStatus::balancing);
    }
    Simulation resumed = make();
    resumed.restore(snapshot_from_bytes(to_bytes(part.snapshot())));
    EXPECT_EQ(run_static(whole, 1.0), of.end);
    EXPECT_EQ(run_static(resumed, 1.0), of.end);
    EXPECT_EQ(whole.steps(), resumed.steps());
    EXPECT_EQ(whole.states()[0].position, resumed.states()[0].position);
  }
}

TEST(StaticAnalysis, BlocksThatNothingHoldsAreNamed) {
  BlockDefinition guided = block_of("G", Polyhedron(make_box({20, 0, 0}, {21, 1, 1})), rock, 1);
  guided.supports.push_back({Plane{{20, 0, 0}, {1, 0, 0}}, {false, true, true}});
  BlockDefinition held = cantilever(2);
  Simulation simulation(models(block_of("A", Polyhedron(make_box({40, 0, 0}, {41, 1, 1})), rock, 1), held,
                               guided, block_of("C", Polyhedron(make_box({40, 0, 1}, {41, 1, 2})), rock, 1),
                               block_of("D", Polyhedron(make_box({7, 0, 0.5}, {7.5, 0.5, 1})), rock, 1)),
                        {{}, {}, {}, {}, {}}, same_law({1e10, 5e9, 0.5, 0.0, 0.0, true}), {});
  EXPECT_EQ(simulation.loose_blocks(), (std::vector<std::vector<int>>{{0, 3}, {2}}));
}

}  // namespace
}  // namespace ashlar

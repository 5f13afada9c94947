// Static analyses with answers by hand: equilibrium, sufficient friction, no support.
#include "solver/statics/static_analysis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"
#include "unit/solver/statics/sample_statics.hpp"

namespace ashlar::static_analysis_test {
namespace {

using test_support::block_of;
using test_support::fixed_block;
using test_support::fixed_box;
using test_support::models;
using test_support::on_incline;
using test_support::place_of;
using test_support::rock;
using test_support::run_static;
using test_support::same_law;

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
    // The pressure is rho g and the compression of springs is rho g / kn, but for the base that grows by Poisson's
    // ratio times rho g / (2 E), here 2.6e-7, in both directions.
    if (order == 1) {
      EXPECT_NEAR(simulation.largest_penetration() / (2700.0 * 9.81 / 1e10), 1.0, 1e-6);
    }
  }
}

TEST(StaticAnalysis, BlockSticksOnAnIncline) {
  Simulation simulation = on_incline(30, 31);
  const Vector3 start = place_of(simulation, 0, {0, 0, 0});
  ASSERT_EQ(run_static(simulation, 1.0), StaticStatus::equilibrium);
  EXPECT_TRUE(simulation.moving_blocks().empty());
  // The springs of 1e10 N/m transmit m g: the compression of the block is of the order of m g / k.
  EXPECT_LT((place_of(simulation, 0, {0, 0, 0}) - start).norm(), 10.0 * 2700.0 * 9.81 / 1e10);
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

TEST(StaticAnalysis, SoftPlatesOnStiffPiersSettleWithMultipliers) {
  // The forces at the corners of the piers converge far more slowly than their depths.
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
}  // namespace ashlar::static_analysis_test

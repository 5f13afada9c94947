// Motion with known answers: free flight, bounces, inclines, collisions (verification cases of record).
#include "solver/run/simulation.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "solver/run/checkpoint.hpp"
#include "support/sample_solids.hpp"
#include "support/simulations.hpp"

namespace ashlar::simulation_test {
namespace {

using test_support::block_of;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;
using test_support::tilted_box;

const Material rock{3600.0, 5e10, 0.2};

BlockDefinition fixed_block(Polyhedron solid) {
  BlockDefinition block = block_of("base", std::move(solid), rock, 1);
  block.fixed = true;
  return block;
}

template <class... Definitions>
std::vector<BlockModel> models(Definitions... definitions) {
  std::vector<BlockModel> result;
  (result.emplace_back(std::move(definitions)), ...);
  return result;
}

TEST(Simulation, FreeFallIsExact) {
  for (const int order : {1, 3, 6}) {
    for (const auto& [name, solid] : test_support::sample_solids()) {
      if (name == "far box" || name == "plate") continue;
      SimulationSettings settings;
      settings.time_step = 0.01;
      Simulation simulation(models(block_of(name, solid, rock, order)), {{}}, same_law({}), settings);
      const Vector3 point = solid.mesh().points[1];
      ASSERT_TRUE(run_until(simulation, 1.0));
      EXPECT_EQ(simulation.steps(), 100);
      const Vector3 fall = place_of(simulation, 0, point) - point;
      EXPECT_NEAR(fall.z() / (-0.5 * 9.81), 1.0, 1e-12) << name << order;
      EXPECT_NEAR(fall.head<2>().norm(), 0.0, 1e-12);
      EXPECT_NEAR(simulation.ledger().residual, 0.0, 1e-9 * simulation.ledger().kinetic);
    }
  }
}

TEST(Simulation, TimesAreMultiplesOfTheStepAndTheLastStepIsAWholeOne) {
  SimulationSettings settings;
  settings.time_step = 2e-3;
  Simulation simulation(models(block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1)), {{}},
                        same_law({}), settings);
  constexpr double end = 30.0;
  while (!simulation.reached(end)) {
    ASSERT_EQ(simulation.step(end), StepStatus::accepted);
    ASSERT_EQ(simulation.time(), 2 * simulation.steps() / 1e3);
    ASSERT_EQ(simulation.report().step, 2e-3);
  }
  EXPECT_EQ(simulation.steps(), 15000);
  // The remaining time up to a later end is a separate step unless it is within rounding error.
  const double sliver = end * (1.0 + 1e-15);
  EXPECT_TRUE(simulation.reached(sliver));
  EXPECT_TRUE(simulation.reached(end + 1e-12));
  EXPECT_FALSE(simulation.reached(end + 1e-10));
  ASSERT_EQ(simulation.step(end + 1e-10), StepStatus::accepted);
  EXPECT_NEAR(simulation.report().step, 1e-10, 1e-14);
}

TEST(Simulation, AStepThatEndsASliverBeforeTheEndIsTheLastOne) {
  SimulationSettings settings;
  settings.time_step = 1e-3;
  for (const double sliver : {-1e-13, 1e-13}) {
    Simulation simulation(models(block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), rock, 1)), {{}},
                          same_law({}), settings);
    ASSERT_TRUE(run_until(simulation, 0.01 + sliver));
    EXPECT_EQ(simulation.steps(), 10);
    EXPECT_EQ(simulation.time(), 0.01);
  }
}

TEST(Simulation, TimesAfterACutAreMultiplesFromThere) {
  // Falls on a floor without contact springs that would slow it before: cut to the first touch.
  SimulationSettings settings;
  settings.time_step = 1e-3;
  InitialMotion motion;
  motion.velocity = {0, 0, -20};
  Simulation simulation(models(block_of("A", Polyhedron(make_box({0, 0, 0.1}, {0.2, 0.2, 0.3})), rock, 1),
                               fixed_block(Polyhedron(make_box({-1, -1, -0.005}, {1, 1, 0})))),
                        {motion, {}}, same_law({1e9, 1e9, 0.0, 0.0, 0.0, true}), settings);
  double start = 0.0;
  int count = 0;
  double last = 0.0;
  int changes = 0;
  while (!simulation.reached(0.05)) {
    ASSERT_EQ(simulation.step(0.05), StepStatus::accepted);
    const double step = simulation.report().step;
    if (step != last && last != 0.0) {
      start = decimal_sum(start, count, last);
      count = 0;
      ++changes;
    }
    last = step;
    ++count;
    ASSERT_EQ(simulation.time(), decimal_sum(start, count, step));
  }
  EXPECT_NEAR(simulation.time(), 0.05, 1e-12);
  EXPECT_GT(changes, 0) << "no step was cut";
}

/// A 1 x 2 x 3 box of order 1 turned by 0.01 rad per step for 628 steps, without gravity.
Simulation spinning_box(Integrator integrator, const Material& material) {
  SimulationSettings settings;
  settings.gravity.setZero();
  settings.integrator = integrator;
  settings.time_step = 0.01;
  InitialMotion motion;
  motion.angular_velocity = {0, 0, 1};
  Simulation simulation(models(block_of("A", Polyhedron(make_box({0, 0, 0}, {1, 2, 3})), material, 1)),
                        {motion}, same_law({}), settings);
  EXPECT_TRUE(run_until(simulation, 6.28));
  return simulation;
}

TEST(Simulation, SpinKeepsVolume) {
  // The centrifugal stretch rho w^2 L^2 / E is below 1e-10; rotation itself must add nothing.
  const Simulation simulation = spinning_box(Integrator::dda, {1.0, 1e11, 0.2});
  std::vector<Vector3> points;
  for (const Vector3& point : simulation.blocks()[0].solid().mesh().points)
    points.push_back(place_of(simulation, 0, point));
  double volume = 0.0;
  for (const auto& [a, b, c] : simulation.blocks()[0].solid().mesh().triangles) {
    volume += points[static_cast<std::size_t>(a)].dot(
                  points[static_cast<std::size_t>(b)].cross(points[static_cast<std::size_t>(c)])) /
              6.0;
  }
  EXPECT_NEAR(volume, 6.0, 6.0 * 1e-10);
}

TEST(Simulation, SpinKeepsAngularMomentum) {
  // rho V (1^2 + 2^2)/12 times 1 rad/s; the centroid rests.
  const Vector3 expected(0, 0, 1000.0 * 6.0 * 5.0 / 12.0);
  for (const Integrator integrator :
       {Integrator::dda, Integrator::generalized_alpha, Integrator::average_acceleration}) {
    const Simulation simulation = spinning_box(integrator, {1000.0, 1e7, 0.2});
    EXPECT_LT((simulation.angular_momentum() - expected).norm(), 1e-8 * expected.norm());
  }
}

TEST(Simulation, BouncePenetrationAndDuration) {
  // m = 12150 kg from 1 m on a total stiffness of 1e9 N/m: k x^2/2 - m g x - m g h = 0, half a period plus
  // the static part.
  for (const bool area_springs : {true, false}) {
    SimulationSettings settings;
    settings.integrator = Integrator::average_acceleration;
    settings.time_step = 0.0110044 / 200;
    settings.area_springs = area_springs;
    JointLaw law;
    law.area_springs = area_springs;
    law.normal_stiffness = area_springs ? 1e9 / 2.25 : 1e9 / 4.0;
    Simulation simulation(
        models(block_of("A", Polyhedron(make_box({0, 0, 1}, {1.5, 1.5, 2.5})), {3600, 1e14, 0.2}, 1),
               fixed_block(Polyhedron(make_box({-1, -1, -1}, {3, 3, 0})))),
        {{}, {}}, same_law(law), settings);
    const double start = simulation.ledger().balance();
    double first_touch = 0.0;
    double last_touch = 0.0;
    while (!simulation.reached(0.6)) {
      ASSERT_EQ(simulation.step(0.6), StepStatus::accepted);
      if (simulation.report().locked + simulation.report().sliding > 0) {
        if (first_touch == 0.0) first_touch = simulation.time() - simulation.report().step;
        last_touch = simulation.time();
      }
      EXPECT_LT(simulation.ledger().kinetic + simulation.ledger().elastic + simulation.ledger().gravity +
                    simulation.ledger().contact,
                start + 1e-3 * std::abs(start));
    }
    EXPECT_NEAR(simulation.largest_penetration(), 0.0155593, 0.01 * 0.0155593);
    EXPECT_NEAR(last_touch - first_touch, 0.0110044, 0.01 * 0.0110044 + settings.time_step);
  }
}

/// Slide of a 1 m cube on a plane of given inclination after a time, from rest. Down-slope is -x turned.
double slide_on_incline(double incline, double friction_angle, double time, bool area_springs, int order,
                        double step = 1e-3) {
  SimulationSettings settings;
  settings.time_step = step;
  settings.area_springs = area_springs;
  JointLaw law;
  law.area_springs = area_springs;
  law.normal_stiffness = area_springs ? 1e10 : 1e10 / 4.0;
  law.shear_stiffness = law.normal_stiffness;
  law.friction = std::tan(friction_angle * std::numbers::pi / 180.0);
  Simulation simulation(
      models(block_of("A", tilted_box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, incline), {2700, 1e10, 0.2}, order),
             fixed_block(tilted_box({-6, -2, -1}, {2, 2, 0}, incline))),
      {{}, {}}, same_law(law), settings);
  EXPECT_TRUE(run_until(simulation, time));
  const Vector3 move =
      simulation.states()[0].position.row(0) - simulation.blocks()[0].basis().identity_map().row(0);
  return move.norm() / std::sqrt(simulation.blocks()[0].basis().volume());
}

TEST(Simulation, InclineSlide) {
  for (const bool area_springs : {true, false}) {
    EXPECT_NEAR(slide_on_incline(30, 20, 1.0, area_springs, 1), 0.9064074, 0.005 * 0.9064074);
    EXPECT_NEAR(slide_on_incline(30, 0, 1.0, area_springs, 1), 2.4525, 0.005 * 2.4525);
    EXPECT_NEAR(slide_on_incline(45, 30, 1.0, area_springs, 1), 1.4659009, 0.005 * 1.4659009);
  }
  EXPECT_NEAR(slide_on_incline(30, 20, 1.0, true, 2), 0.9064074, 0.005 * 0.9064074);
}

TEST(Simulation, InclineStick) {
  const double after_2 = slide_on_incline(30, 31, 2.0, true, 1, 2e-3);
  const double after_10 = slide_on_incline(30, 31, 10.0, true, 1, 2e-3);
  // The normal spring needs about one step to take the weight; three steps of free sliding are more than
  // that.
  EXPECT_LT(after_2, 0.5 * 9.81 * 0.5 * std::pow(3 * 2e-3, 2));
  EXPECT_NEAR(after_10, after_2, 1e-9);
}

TEST(Simulation, BlocksOfDifferentOrdersInOneScene) {
  // A cube of order 1 rests on a thick plate of order 3 on a fixed base: the forces add up to the weights.
  SimulationSettings settings;
  settings.time_step = 2e-3;
  settings.search.subdivisions = 1;
  JointLaw law{1e9, 5e8, 0.5, 0.0, 0.0, true};
  Simulation simulation(
      models(block_of("A", Polyhedron(make_box({-0.5, -0.5, 1}, {0.5, 0.5, 2})), {2500, 1e9, 0.2}, 1),
             block_of("B", Polyhedron(make_box({-2, -2, 0}, {2, 2, 1})), {2500, 1e9, 0.2}, 3),
             fixed_block(Polyhedron(make_box({-5, -5, -1}, {5, 5, 0})))),
      {{}, {}, {}}, same_law(law), settings);
  ASSERT_TRUE(run_until(simulation, 1.0));
  double on_a = 0.0;
  double on_b_from_base = 0.0;
  for (const PairRecord& pair : simulation.contacts()) {
    double sum = 0.0;
    for (std::size_t k = 0; k < pair.points.size(); ++k)
      sum += pair.responses[k].force[0] * pair.points[k].normal.z();
    (pair.a == 0 ? on_a : on_b_from_base) += sum;
  }
  EXPECT_NEAR(on_a, 2500 * 9.81, 1e-3 * 2500 * 9.81);
  EXPECT_NEAR(on_b_from_base, 17 * 2500 * 9.81, 1e-3 * 17 * 2500 * 9.81);
}

// A run has one start: its parts are refused once contacts are detected, and nothing changes then.
TEST(Simulation, PartsOfTheStartAreRefusedAfterAStep) {
  SimulationSettings settings;
  settings.time_step = 1e-2;
  settings.gravity = {0, 0, -10};
  const auto make = [&] {
    return Simulation(models(block_of("A", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), rock, 1)), {{}},
                      same_law({}), settings);
  };
  const auto refuses_all = [](Simulation& simulation) {
    const std::string before = to_bytes(simulation.snapshot());
    EXPECT_THROW(simulation.start_overlapping({}), std::logic_error);
    EXPECT_THROW(simulation.start_stressed(), std::logic_error);
    EXPECT_THROW(simulation.add_bolts({}), std::logic_error);
    EXPECT_THROW(simulation.settle_supported_blocks(), std::logic_error);
    EXPECT_THROW((void)simulation.start_from_statics(), std::logic_error);
    EXPECT_THROW(simulation.start_stage(simulation.snapshot(), {false}), std::logic_error);
    EXPECT_EQ(to_bytes(simulation.snapshot()), before);
  };
  Simulation stepped = make();
  ASSERT_EQ(stepped.step(1.0), StepStatus::accepted);
  refuses_all(stepped);
  Simulation resumed = make();
  resumed.restore(stepped.snapshot());
  refuses_all(resumed);
  // The stage before may end where it started: its contacts have been detected all the same.
  Simulation staged = make();
  staged.start_stage(make().snapshot(), {false});
  refuses_all(staged);
}

TEST(Simulation, BoltsAreAddedTogether) {
  const auto bolt = [] {
    BoltLaw law;
    law.axial_stiffness = 1e7;
    law.anchorage = BoltAnchorage::ends;
    const std::vector<BoltSpan> ends = {{0, 1, 0.0, 0.0}, {1, 1, 0.5, 0.5}};
    return Bolt{"bar",
                BoltChain(law, BoltShape(law, {0.5, 0.5, 2}, {0.5, 0.5, 2.5}, ends, 0.02), {true, true}),
                true};
  };
  Simulation simulation(models(block_of("A", Polyhedron(make_box({0, 0, 1}, {1, 1, 2})), rock, 1),
                               fixed_block(Polyhedron(make_box({0, 0, 2.5}, {1, 1, 3})))),
                        {{}, {}}, same_law({}), {});
  simulation.add_bolts({bolt()});
  EXPECT_THROW(simulation.add_bolts({bolt()}), std::logic_error);
  EXPECT_EQ(simulation.system().bolts().size(), 1U);
}

TEST(Simulation, ResultsDoNotDependOnThreads) {
  std::vector<Vector3> places;
  for (const int threads : {1, 2, 8}) {
    SimulationSettings settings;
    settings.threads = threads;
    settings.time_step = 1e-3;
    JointLaw law{1e9, 5e8, 0.5, 0.0, 0.0, true};
    Simulation simulation(
        models(block_of("A", tilted_box({-0.5, -0.5, 1.2}, {0.5, 0.5, 2.2}, 5), {2500, 1e9, 0.2}, 2),
               block_of("B", Polyhedron(make_box({-2, -2, 0}, {2, 2, 1})), {2500, 1e9, 0.2}, 1),
               fixed_block(Polyhedron(make_box({-5, -5, -1}, {5, 5, 0})))),
        {{}, {}, {}}, same_law(law), settings);
    ASSERT_TRUE(run_until(simulation, 0.4));
    places.push_back(place_of(simulation, 0, {0.5, 0.5, 1.2}));
  }
  EXPECT_EQ(places[0], places[1]);
  EXPECT_EQ(places[0], places[2]);
}

}  // namespace
}  // namespace ashlar::simulation_test

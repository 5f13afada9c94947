// Joints that open where they slide, in motion and in statics, against values by hand
// (mechanics/notes/dilation.md).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::joint_dilation_test {
namespace {

using test_support::block_of;
using test_support::fixed_box;
using test_support::place_of;
using test_support::run_until;
using test_support::same_law;

constexpr double gravity = 9.81;

JointLaw dilating(double friction, double dilation, bool area = true) {
  JointLaw law{area ? 1e10 : 2.5e9, area ? 5e9 : 1.25e9, friction, 0.0, 0.0, area};
  law.dilation = dilation;
  return law;
}

/// A slab on a plate that starts along its path, up its dilation.
Simulation sliding_slab(const JointLaw& law, const SimulationSettings& settings, int order, double speed,
                        double turn = 0.0) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {4, 2, 0}));
  const Eigen::AngleAxisd about(turn, Vector3::UnitZ());
  blocks.emplace_back(
      block_of("slab", test_support::turned(Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.1})), about),
               {2500, 1e9, 0.2}, order));
  return {std::move(blocks),
          {{}, {speed * (about * Vector3(1, 0, law.dilation)), Vector3::Zero()}},
          same_law(law),
          settings};
}

struct Method {
  Integrator integrator;
  int order;
  bool area;
  bool augmented;
};

class SlidingUp : public testing::TestWithParam<Method> {};

// m x'' = -N tan(phi), m z'' = N - m g, z = x tan(psi):  N = m g / (1 + tan(phi) tan(psi)); it comes to rest after
// s = v^2 m / (2 N tan(phi)), has risen by s tan(psi), and sliding has taken N (tan(phi) - tan(psi)) s.
TEST_P(SlidingUp, UnderConstantLoadRisesBySlipTimesTangent) {
  const Method& method = GetParam();
  constexpr double friction = 0.5, dilation = 0.15, speed = 1.5, mass = 250.0;
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.integrator = method.integrator;
  settings.area_springs = method.area;
  settings.augmented = method.augmented;
  settings.contact_distance = 1e-3;  // far less than it rises
  settings.rest.sleeps = false;
  JointLaw law = dilating(friction, dilation, method.area);
  // It starts without pressure. Undamped, it bounces without end, and slips in flight.
  if (method.integrator == Integrator::average_acceleration && !method.augmented) law.damping = 0.3;
  Simulation simulation = sliding_slab(law, settings, method.order, speed, 0.3);
  const Vector3 start = place_of(simulation, 1, {0, 0, 0});
  ASSERT_TRUE(run_until(simulation, 0.5));
  const Vector3 moved = place_of(simulation, 1, {0, 0, 0}) - start;
  const double normal = mass * gravity / (1.0 + friction * dilation);
  const double slip = 0.5 * speed * speed * mass / (normal * friction);
  EXPECT_NEAR(moved.head<2>().norm(), slip, 0.01 * slip);
  EXPECT_NEAR(moved.z() / moved.head<2>().norm(), dilation, 1e-3 * dilation);
  const Ledger& ledger = simulation.ledger();
  const double dissipated = normal * (friction - dilation) * slip;
  EXPECT_NEAR(ledger.friction, dissipated, 0.02 * dissipated);
  EXPECT_LT(simulation.largest_step_residual(), 1e-9 * simulation.largest_energy());
  EXPECT_LT(ledger.redetection_gained, 1e-8 * simulation.largest_energy());
  EXPECT_LT(std::abs(ledger.numerical) + ledger.damping, 0.03 * dissipated);
}

INSTANTIATE_TEST_SUITE_P(Of, SlidingUp,
                         testing::Values(Method{Integrator::dda, 1, true, false},
                                         Method{Integrator::dda, 2, false, false},
                                         Method{Integrator::dda, 0, true, false},
                                         Method{Integrator::average_acceleration, 1, true, false},
                                         Method{Integrator::average_acceleration, 2, true, false},
                                         Method{Integrator::generalized_alpha, 1, true, false},
                                         Method{Integrator::dda, 1, true, true},
                                         Method{Integrator::average_acceleration, 1, true, true}));

/// A prism of 1 m^2 on a plate, its top pressed down by w and moved aside by u in time.
class Confined {
 public:
  static constexpr double height = 0.5, young = 1e9, squeezed = 1e-3, shift = 4e-3;
  static constexpr double kn = 4e9, ks = 3e9;

  static Simulation block(double friction, double dilation, bool augmented, bool there_and_back = false) {
    BlockDefinition prism =
        block_of("prism", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, height})), {2500, young, 0.0}, 1);
    const Vector3 down(0, 0, -squeezed);
    SupportHistory history{{0.0, 0.2, 1.0}, {Vector3::Zero(), down, down + Vector3(shift, 0, 0)}};
    if (there_and_back) {
      history.times.push_back(1.8);
      history.values.push_back(down);
    }
    prism.supports.push_back({Plane{{0, 0, height}, Vector3::UnitZ()}, {true, true, true}, history});
    std::vector<BlockModel> blocks;
    blocks.emplace_back(fixed_box({-1, -1, -1}, {1, 1, 0}));
    blocks.emplace_back(std::move(prism));
    JointLaw law{kn, ks, friction, 0.0, 0.0, true};
    law.dilation = dilation;
    SimulationSettings settings;
    settings.gravity.setZero();
    settings.time_step = 0.1;
    settings.contact_distance = 1e-4;
    settings.augmented = augmented;
    settings.multipliers.penetration_tolerance = 1e-7;
    return {std::move(blocks), {{}, {}}, same_law(law), settings};
  }

  /// Stress of springs in series: sigma = K (w + s tan(psi)), s = u - sigma tan(phi) C.
  static double stress(double friction, double dilation, bool springs) {
    const double normal = 1.0 / (height / young + (springs ? 1.0 / kn : 0.0));
    const double shear = 2.0 * height / young + (springs ? 1.0 / ks : 0.0);
    return normal * (squeezed + dilation * shift) / (1.0 + normal * dilation * friction * shear);
  }

  static Vector3 force(const Simulation& simulation) { return force_on_a(simulation.contacts().at(0)); }
};

// Sliding between two levels, over several of them: the slip of one is the start of the next.
TEST(JointDilation, UnderConstantStiffnessNormalStressRisesBySlip) {
  for (const bool augmented : {false, true}) {
    for (const double dilation : {0.0, 0.1, 0.3}) {
      constexpr double friction = 0.3;
      Simulation simulation = Confined::block(friction, dilation, augmented);
      StaticStatus status = StaticStatus::balancing;
      while (status == StaticStatus::balancing) status = simulation.static_step(1.0);
      ASSERT_EQ(status, StaticStatus::equilibrium) << augmented << " " << dilation;
      const double reference = Confined::stress(friction, dilation, !augmented);
      const Vector3 force = Confined::force(simulation);
      EXPECT_NEAR(std::abs(force.z()), reference, 5e-3 * reference) << augmented << " " << dilation;
      EXPECT_NEAR(force.head<2>().norm(), friction * std::abs(force.z()), 1e-6 * reference);
    }
  }
}

// There and back: both ways open it, so that it presses more than at the turn.
TEST(JointDilation, SlidingBackOpensOn) {
  constexpr double friction = 0.3, dilation = 0.1;
  Simulation simulation = Confined::block(friction, dilation, false, true);
  StaticStatus status = StaticStatus::balancing;
  while (status == StaticStatus::balancing) status = simulation.static_step(1.8);
  ASSERT_EQ(status, StaticStatus::equilibrium);
  // On the way back, the reversal of shear strain is no slip: with t = sigma tan(phi) C before and after,
  // s2 = u - t1 - t2, and sigma2 = sigma1 + K tan(psi) s2.
  const double normal = 1.0 / (Confined::height / Confined::young + 1.0 / Confined::kn);
  const double give = friction * (2.0 * Confined::height / Confined::young + 1.0 / Confined::ks);
  const double first = Confined::stress(friction, dilation, true);
  const double second =
      (first + normal * dilation * (Confined::shift - first * give)) / (1.0 + normal * dilation * give);
  EXPECT_NEAR(std::abs(Confined::force(simulation).z()), second, 5e-3 * second);
}

TEST(JointDilation, ResumedRunsAndThreadsHaveTheSameBits) {
  for (const bool damped : {false, true}) {
    JointLaw law = dilating(0.5, 0.2);
    law.damping = damped ? 0.3 : 0.0;
    SimulationSettings settings;
    settings.contact_distance = 1e-3;
    const auto make = [&](int threads) {
      settings.threads = threads;
      return sliding_slab(law, settings, 2, 1.5, 0.3);
    };
    const auto bits = [](const Simulation& simulation) {
      SimulationSnapshot snapshot = simulation.snapshot();
      snapshot.run.log.seconds = {};
      snapshot.run.log.counts.factors = {};
      return to_bytes(snapshot);
    };
    Simulation straight = make(1), threaded = make(2);
    ASSERT_TRUE(run_until(straight, 0.1));
    Simulation resumed = make(1);
    resumed.restore(snapshot_from_bytes(to_bytes(straight.snapshot())));
    for (Simulation* simulation : {&straight, &threaded, &resumed}) ASSERT_TRUE(run_until(*simulation, 0.2));
    EXPECT_EQ(bits(resumed), bits(straight));
    EXPECT_EQ(bits(threaded), bits(straight));
  }
}

// An opening by dilation is no gap: pressed down at rest the slab keeps its height.
TEST(JointDilation, WhatHasRisenStaysUp) {
  SimulationSettings settings;
  settings.contact_distance = 1e-3;
  settings.rest.sleeps = false;
  Simulation simulation = sliding_slab(dilating(0.5, 0.2), settings, 1, 1.5);
  ASSERT_TRUE(run_until(simulation, 0.6));
  const double risen = place_of(simulation, 1, {0, 0, 0}).z();
  EXPECT_GT(risen, 0.03);
  ASSERT_TRUE(run_until(simulation, 1.0));
  EXPECT_NEAR(place_of(simulation, 1, {0, 0, 0}).z(), risen, 1e-6);
}

/// A cube on a plate.
Simulation cube(double dilation, const Vector3& velocity, double step) {
  std::vector<BlockModel> blocks;
  blocks.emplace_back(fixed_box({-2, -2, -1}, {4, 2, 0}));
  blocks.emplace_back(
      block_of("cube", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), {2500, 1e9, 0.2}, 1));
  SimulationSettings settings;
  settings.time_step = step;
  return {std::move(blocks), {{}, {velocity, Vector3::Zero()}}, same_law(dilating(0.5, dilation)), settings};
}

TEST(DilatingSlip, WhatHopsSlidesInFlight) {
  // It starts along the plate and not up its dilation, which throws it up. Only the rest of the slip dilates.
  Simulation hops = cube(0.15, {2, 0, 0}, 1e-3);
  ASSERT_TRUE(run_until(hops, 0.2));
  const double slip = place_of(hops, 1, {0, 0, 0.5}).x();
  const DilatingSlip& slid = hops.dilating_slip();
  EXPECT_LT(slid.all, 1.01 * slip);  // its base has an area of 1 m^2; what is far off its joint is not on it
  EXPECT_GT(slid.flown_share(), 0.5);
  double risen = 0.0;
  for (const auto& [blocks, pair] : hops.histories()) risen = std::max(risen, pair.memory.most_dilation());
  EXPECT_LT(risen, 0.1 * slip * 0.15);
}

TEST(DilatingSlip, WhatSlidesOnItsJointDoesNot) {
  constexpr double speed = 1.5;
  SimulationSettings settings;
  settings.time_step = 1e-3;
  Simulation slab = sliding_slab(dilating(0.5, 0.15), settings, 1, speed);
  ASSERT_TRUE(run_until(slab, 0.1));
  EXPECT_GT(slab.dilating_slip().all, 0.05);
  EXPECT_LT(slab.dilating_slip().flown_share(), 0.02);
  // Where nothing dilates nothing is counted.
  Simulation plain = cube(0.0, {2, 0, 0}, 1e-3);
  ASSERT_TRUE(run_until(plain, 0.02));
  EXPECT_EQ(plain.dilating_slip().all, 0.0);
}

}  // namespace
}  // namespace ashlar::joint_dilation_test

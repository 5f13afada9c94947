// Limits of blocks that are held by bolts, cables and props, by hand.
#include "solver/limit/rigid_bolts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "solver/paths/thrust.hpp"
#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::rigid_bolts_test {
namespace {

using test_support::g;
using test_support::joint;
using test_support::LimitScene;
using test_support::rock;
using test_support::tangent_of;

constexpr double tolerance = 1e-3;

BoltLaw grouted(double yield_force, double bond_strength) {
  BoltLaw law;
  law.axial_stiffness = 1e8;
  law.yield_force = yield_force;
  law.bond_stiffness = 1e9;
  law.bond_strength = bond_strength;
  return law;
}

BoltLaw at_ends(double yield_force, bool tension, bool compression) {
  BoltLaw law;
  law.anchorage = BoltAnchorage::ends;
  law.axial_stiffness = 1e8;
  law.yield_force = yield_force;
  law.tension = tension;
  law.compression = compression;
  return law;
}

/// A bolt through blocks; the ends of its pieces are in m along it.
Bolt through(const BoltLaw& law, const Vector3& from, const Vector3& to,
             const std::vector<std::pair<int, std::array<double, 2>>>& pieces) {
  std::vector<BoltSpan> spans;
  for (const auto& [block, ends] : pieces) spans.push_back({block, 1, ends[0], ends[1]});
  const std::vector<bool> present(spans.size(), true);
  return {"bolt", BoltChain(law, BoltShape(law, from, to, std::move(spans), 0.025), present), true};
}

Bolt between(const BoltLaw& law, int first, const Vector3& from, int second, const Vector3& to) {
  const double length = (to - from).norm();
  return through(law, from, to, {{first, {0.0, 0.0}}, {second, {length, length}}});
}

/// Rigid model of a scene with bolts. @param multiplied by block
RigidModel model_with(const LimitScene& scene, std::vector<Bolt> bolts,
                      const std::vector<bool>& multiplied = {}) {
  Simulation simulation = scene.build();
  simulation.add_bolts(std::move(bolts));
  return simulation.rigid_model(1.0, multiplied);
}

LimitAnalysis analysis_of(RigidModel model) {
  return LimitAnalysis(
      std::move(model), [](int, int) { return true; }, 1);
}

void expect_bracket(const LimitBracket& bracket, double factor, const std::string& what) {
  ASSERT_TRUE(bracket.lower && bracket.upper && bracket.resolved) << what;
  EXPECT_LE(*bracket.lower, factor * (1.0 + 5e-4)) << what;
  EXPECT_GE(*bracket.upper, factor * (1.0 - 5e-4)) << what;
}

/// Factor of the loads of blocks, both limits.
void expect_load_factor(const RigidModel& model, double factor, const std::string& what) {
  const LimitAnswer answer =
      analysis_of(model).load_factor({0.01 * factor, 100.0 * factor, tolerance}, [] { return true; });
  expect_bracket(answer.associated, factor, what + ", associated");
  expect_bracket(answer.released, factor, what + ", released");
}

void pull(LimitScene& scene, int block, const Vector3& place, const Vector3& force) {
  scene.blocks[static_cast<std::size_t>(block)].loads.push_back({place, false, force, {}});
}

/// Blocks in a row along x without weight: a fixed one of 2 m, one of 0.3 m and one of 0.5 m, with a gap between them,
/// and a bolt through their middle.
struct Row {
  explicit Row(double gap) {
    scene.gravity.setZero();
    const auto box = [](double low, double high) {
      return Polyhedron(make_box({low, -0.25, -0.25}, {high, 0.25, 0.25}));
    };
    scene.add_fixed(box(-2, 0));
    const double one = gap, two = one + 0.3 + gap;
    scene.add("one", box(one, one + 0.3));
    scene.add("two", box(two, two + 0.5));
    ends = {{0, {0, 2}}, {1, {2 + one, 2.3 + one}}, {2, {2 + two, 2.5 + two}}};
    to = Vector3(two + 0.5, 0, 0);
  }
  [[nodiscard]] RigidModel model(const BoltLaw& law, double on_one, double on_two) const {
    LimitScene pulled = scene;
    if (on_one != 0.0) pull(pulled, 1, {0.1, 0, 0}, {on_one, 0, 0});
    if (on_two != 0.0) pull(pulled, 2, {0.6, 0, 0}, {on_two, 0, 0});
    return model_with(pulled, {through(law, {-2, 0, 0}, to, ends)}, {false, true, true});
  }

  LimitScene scene;
  std::vector<std::pair<int, std::array<double, 2>>> ends;
  Vector3 to;
};

TEST(RigidBolts, ABoltThroughTwoJointsIsLimitedBySteelAndGrout) {
  // Grout of 100 kN/m: 200 kN, 30 kN and 50 kN.
  constexpr double bond = 1e5;
  const Row apart(0.01), touching(0.0);
  for (const auto& [yield, on_one, on_two, factor] : {
           std::array{1e6, 0.0, 1e3, 50.0},   // the last block slides off the bar
           std::array{4e4, 0.0, 1e3, 40.0},   // the steel yields in both joints
           std::array{1e6, 1e3, 10.0, 30.0},  // the middle one slides along it
           std::array{1e6, 1e3, 1e3, 30.0},   // as N_2 = P and N_1 = 2 P
           std::array{5e4, 1e3, 1e3, 25.0},   // 2 P is the yield force
           std::array{1e6, 1e3, 3e3, 50.0 / 3.0},
       }) {
    expect_load_factor(apart.model(grouted(yield, bond), on_one, on_two), factor,
                       std::to_string(yield) + " " + std::to_string(on_one) + " " + std::to_string(on_two));
  }
  // A block that touches the last one presses against it: grout of both holds.
  expect_load_factor(touching.model(grouted(1e6, bond), 1e3, 0.0), 80.0, "pressed on");
  expect_load_factor(touching.model(grouted(6e4, bond), 1e3, 0.0), 60.0, "pressed on, yields");
}

TEST(RigidBolts, OnlyGroutThatMaySlipHasABarOfItsOwn) {
  const Row row(0.01);
  EXPECT_EQ(row.model(grouted(1e6, 1e5), 0.0, 1e3).bodies.size(), 3U);
  EXPECT_EQ(loaded_bodies(row.model(grouted(1e6, 1e5), 0.0, 1e3)), 2U);
  // 30 kN of grout in the middle hold a bar that yields at 20 kN.
  EXPECT_EQ(row.model(grouted(2e4, 1e5), 0.0, 1e3).bodies.size(), 2U);
}

TEST(RigidBolts, OfASlopeHasTheFactorOfTheClosedForm) {
  // F = (W cos a + T sin b) tan phi / (W sin a - T cos b)
  constexpr double incline = 40.0, phi = 30.0;
  const double weight = rock.density * g;
  for (const auto& [beta, share] : {std::array{40.0, 0.2}, {70.0, 0.3}, {55.0, 0.15}}) {
    const double alpha = incline * std::numbers::pi / 180.0, angle = beta * std::numbers::pi / 180.0;
    const double force = share * weight;
    const double factor = (weight * std::cos(alpha) + force * std::sin(angle)) * tangent_of(phi) /
                          (weight * std::sin(alpha) - force * std::cos(angle));
    LimitScene scene;
    scene.law = joint(tangent_of(phi));
    scene.gravity = g * Vector3(std::sin(alpha), 0.0, -std::cos(alpha));
    scene.add("A", Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 0.5})));
    scene.add_fixed(Polyhedron(make_box({-6, -2, -3}, {6, 2, 0})));
    const Vector3 along(-std::cos(angle), 0.0, -std::sin(angle));
    for (const bool grout : {true, false}) {
      const Vector3 from = -0.4 * along, to = 1.5 * along;
      const Bolt bolt = grout ? through(grouted(force, 1e8), from, to, {{0, {0, 0.4}}, {1, {0.4, 1.9}}})
                              : between(at_ends(force, true, false), 0, from, 1, to);
      const LimitAnswer answer =
          analysis_of(model_with(scene, {bolt})).strength_factor({0.1, 10.0, tolerance}, [] { return true; });
      const std::string what = std::to_string(beta) + (grout ? ", grouted" : ", ends");
      expect_bracket(answer.associated, factor, what + ", associated");
      expect_bracket(answer.released, factor, what + ", released");
    }
  }
}

TEST(RigidBolts, ABoltThatSlidingDoesNotLengthenAddsNothingToTheReleasedFactor) {
  // Square to the plane: associated flow lifts the block, which then lengthens the bolt.
  constexpr double incline = 40.0, phi = 30.0;
  const double weight = rock.density * g, alpha = incline * std::numbers::pi / 180.0;
  LimitScene scene;
  scene.law = joint(tangent_of(phi));
  scene.gravity = g * Vector3(std::sin(alpha), 0.0, -std::cos(alpha));
  scene.add("A", Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 0.5})));
  scene.add_fixed(Polyhedron(make_box({-6, -2, -3}, {6, 2, 0})));
  const Bolt bolt =
      through(grouted(0.3 * weight, 1e8), {0, 0, 0.4}, {0, 0, -1.5}, {{0, {0, 0.4}}, {1, {0.4, 1.9}}});
  const LimitAnswer answer =
      analysis_of(model_with(scene, {bolt})).strength_factor({0.1, 10.0, tolerance}, [] { return true; });
  expect_bracket(answer.released, tangent_of(phi) / tangent_of(incline), "released");
  expect_bracket(answer.associated, (std::cos(alpha) + 0.3) * tangent_of(phi) / std::sin(alpha),
                 "associated");
}

TEST(RigidBolts, HangABlockUpToTheirStrength) {
  // n bolts of strength T hold a block of weight W under a roof that pulls it off by P = n T - W.
  constexpr double strength = 3e4;
  const double weight = 0.5 * rock.density * g;
  for (const int count : {3, 4, 6}) {
    LimitScene scene;
    scene.add_fixed(Polyhedron(make_box({-2, -2, 0}, {2, 2, 2})));
    scene.add("A", Polyhedron(make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0})));
    pull(scene, 1, {0, 0, -0.5}, {0, 0, -1e3});
    std::vector<Bolt> bolts;
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / count;
      const Vector3 place(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0.0);
      bolts.push_back(through(grouted(1e6, strength / 0.4), place + Vector3(0, 0, 1.5),
                              place - Vector3(0, 0, 0.4), {{0, {0, 1.5}}, {1, {1.5, 1.9}}}));
    }
    expect_load_factor(model_with(scene, std::move(bolts), {false, true}), (count * strength - weight) / 1e3,
                       std::to_string(count));
  }
}

TEST(RigidBolts, APropHoldsWhatItsStrengthExceedsTheWeightBy) {
  constexpr double strength = 4e4;
  const double weight = 0.5 * rock.density * g;
  LimitScene scene;
  scene.add_fixed(Polyhedron(make_box({-2, -2, -3}, {2, 2, -2})));
  scene.add("A", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.5})));
  pull(scene, 1, {0, 0, 0.5}, {0, 0, -1e3});
  for (const bool tension : {false, true}) {
    const Bolt prop = between(at_ends(strength, tension, true), 0, {0, 0, -2}, 1, {0, 0, 0});
    expect_load_factor(model_with(scene, {prop}, {false, true}), (strength - weight) / 1e3, "pushed");
    LimitScene lifted = scene;
    lifted.blocks[1].loads.back().vector = Vector3(0, 0, 1e3);
    expect_load_factor(model_with(lifted, {prop}, {false, true}), ((tension ? strength : 0.0) + weight) / 1e3,
                       "lifted");
  }
}

TEST(RigidBolts, ADowelResistsShearUpToItsStrength) {
  constexpr double strength = 2e4;
  LimitScene scene;
  scene.law = joint(0.0);
  scene.add("A", Polyhedron(make_box({-1, -0.5, 0}, {1, 0.5, 0.5})));
  scene.add_fixed(Polyhedron(make_box({-6, -6, -3}, {6, 6, 0})));
  BoltLaw law = grouted(1e6, 1e6);
  law.shear_stiffness = 1e7;
  for (const double limit : {strength, BoltLaw::unlimited}) {
    law.shear_strength = limit;
    const Bolt bolt = through(law, {0, 0, 0.5}, {0, 0, -2}, {{0, {0, 0.5}}, {1, {0.5, 2.5}}});
    LimitScene pushed = scene;
    pull(pushed, 0, {0, 0, 0.1}, Vector3(600, 800, 0));
    const RigidModel model = model_with(pushed, {bolt}, {true, false});
    if (limit == strength) {
      expect_load_factor(model, 20.0, "shear");
    } else {
      const LimitAnswer answer = analysis_of(model).load_factor({0.1, 20.5, tolerance}, [] { return true; });
      EXPECT_EQ(answer.released.lower, 20.5);
      EXPECT_FALSE(answer.released.upper);
    }
  }
}

TEST(RigidBolts, ABarWithoutStrengthHoldsAnyLoad) {
  LimitScene scene;
  scene.add_fixed(Polyhedron(make_box({-2, -2, -3}, {2, 2, -2})));
  scene.add("A", Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.5})));
  pull(scene, 1, {0, 0, 0.5}, {0, 0, -1e3});
  for (const bool tension : {false, true}) {
    const Bolt prop = between(at_ends(BoltLaw::unlimited, tension, true), 0, {0, 0, -2}, 1, {0, 0, 0});
    const LimitAnswer answer =
        analysis_of(model_with(scene, {prop}, {false, true})).load_factor({0.1, 1e4, tolerance}, [] {
          return true;
        });
    EXPECT_EQ(answer.released.lower, 1e4) << tension;
    EXPECT_FALSE(answer.released.upper) << tension;
  }
}

TEST(RigidBolts, OfBlocksThatAreOneBodyAddNothing) {
  Row row(0.0);
  row.scene.ties.push_back({1, 2, 1e14});
  const RigidModel model = row.model(grouted(1e6, 1e5), 0.0, 1e3);
  EXPECT_EQ(model.bodies.size(), 1U);
  // Grout of both holds: 80 kN.
  expect_load_factor(model, 80.0, "tied");
}

TEST(RigidBolts, ForcesAlongABarAreLinearInItsGrout) {
  // P pulls the last block at the limit of 50 kN: 25 kN/m in 2 m of the first, none in the middle, 100 kN/m in the last.
  const Row row(0.01);
  LimitScene scene = row.scene;
  pull(scene, 2, {0.6, 0, 0}, {1e3, 0, 0});
  Simulation simulation = scene.build();
  simulation.add_bolts({through(grouted(1e6, 1e5), {-2, 0, 0}, row.to, row.ends)});
  LimitAnalysis analysis = analysis_of(simulation.rigid_model(1.0, {false, true, true}));
  const LimitAnswer answer = analysis.load_factor({1.0, 1e3, tolerance}, [] { return true; });
  ASSERT_TRUE(answer.released.motion);
  const LimitMotion motion = analysis.motion_of(*answer.released.motion);
  const std::vector<BoltState> states =
      bolts_under(motion.bars, simulation.system().bolts(), simulation.bolts());
  EXPECT_NEAR(largest_axial_force(states[0]), 5e4, 100.0);
  EXPECT_EQ(condition_of(simulation.system().bolts()[0], states[0]), BoltCondition::slipped);
  const std::vector<BoltStation>& stations = simulation.system().bolts()[0].chain.shape().stations();
  const std::array by_piece = {2.5e4, 0.0, -1e5};
  double sum = 0.0;
  for (std::size_t k = 0; k < stations.size(); ++k) {
    const double per_length = states[0].bond[k] / stations[k].length;
    EXPECT_NEAR(per_length, by_piece[static_cast<std::size_t>(stations[k].piece)], 500.0);
    sum += states[0].bond[k];
  }
  EXPECT_NEAR(sum, 0.0, 1e-6);
}

TEST(RigidBolts, OfAKeystoneLowerItsLeastThrust) {
  // Bars of strength T from the stone into both supports: from W/2 cot(b + phi) - T to W/2 cot(b - phi).
  constexpr double strength = 5e3, angle = 30.0, phi = 10.0;
  const double lean = tangent_of(angle);
  const auto prism = [](const std::vector<std::array<double, 2>>& outline) {
    std::vector<Vector3> points;
    for (const auto& [x, z] : outline)
      for (const double y : {0.0, 1.0}) points.emplace_back(x, y, z);
    return Polyhedron(make_convex_hull(points));
  };
  LimitScene scene;
  scene.law = joint(tangent_of(phi));
  scene.add("stone", prism({{-0.5, 0}, {0.5, 0}, {0.5 + lean, 1}, {-0.5 - lean, 1}}));
  scene.add_fixed(prism({{-0.5, 0}, {-0.5 - lean, 1}, {-3, 1}, {-3, 0}}));
  scene.add_fixed(prism({{0.5, 0}, {0.5 + lean, 1}, {3, 1}, {3, 0}}));
  const BoltLaw law = at_ends(strength, true, false);
  const RigidModel model = model_with(scene, {between(law, 0, {0, 0.5, 0.5}, 1, {-2, 0.5, 0.5}),
                                              between(law, 0, {0, 0.5, 0.5}, 2, {2, 0.5, 0.5})});
  const double half = 0.5 * rock.density * g * (1.0 + lean);
  const std::vector<ThrustRange> ranges = thrust_ranges(model, scene.gravity, 1);
  ASSERT_EQ(ranges.size(), 2U);
  for (const ThrustRange& range : ranges) {
    ASSERT_TRUE(range.least && range.most);
    EXPECT_NEAR(range.least->thrust, half / tangent_of(angle + phi) - strength, 1e-4 * half);
    EXPECT_NEAR(range.most->thrust, half / tangent_of(angle - phi), 1e-4 * half);
  }
}

}  // namespace
}  // namespace ashlar::rigid_bolts_test

// Limit analysis of blocks whose factors are known by hand.
#include "solver/limit/limit_analysis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::limit_analysis_test {
namespace {

using test_support::g;
using test_support::groove;
using test_support::joint;
using test_support::leaning_roof;
using test_support::on_slope;
using test_support::rock;
using test_support::tangent_of;
using test_support::tilted_box;
using Scene = test_support::LimitScene;

/// Accelerations up to 1e-4 of the loads count as rest, which is the error of a factor.
constexpr double stillness = 5e-4;

void expect_factor(const LimitBracket& bracket, double factor, double tolerance, const std::string& what) {
  ASSERT_TRUE(bracket.lower && bracket.upper) << what;
  EXPECT_TRUE(bracket.resolved) << what;
  EXPECT_LE(*bracket.lower, factor * (1.0 + stillness)) << what;
  EXPECT_GE(*bracket.upper, factor * (1.0 - stillness)) << what;
  EXPECT_LE(*bracket.upper, *bracket.lower * (1.0 + tolerance) * (1.0 + 1e-12)) << what;
}

void expect_factors(const LimitAnswer& answer, double factor, const std::string& what,
                    double tolerance = 1e-3) {
  expect_factor(answer.associated, factor, tolerance, what + ", associated");
  expect_factor(answer.released, factor, tolerance, what + ", released");
}

TEST(LimitAnalysis, ABlockOnAPlaneHasTheRatioOfTheTangents) {
  for (const auto& [alpha, phi] : {std::pair{30.0, 35.0}, {20.0, 40.0}, {40.0, 25.0}}) {
    for (const int order : {0, 1, 2}) {
      const LimitAnswer answer = on_slope(alpha, joint(tangent_of(phi)), order).safety();
      expect_factors(answer, tangent_of(phi) / tangent_of(alpha),
                     std::to_string(alpha) + " " + std::to_string(order));
      EXPECT_FALSE(answer.interrupted);
    }
  }
}

TEST(LimitAnalysis, AFactorTurnsWithItsScene) {
  const Scene scene = on_slope(30.0, joint(tangent_of(35.0)), 0);
  for (const Eigen::AngleAxisd& turn : {Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()),
                                        Eigen::AngleAxisd(2.5, Vector3(-1, 0.2, 0.7).normalized())})
    expect_factors(scene.turned(turn).safety(), tangent_of(35.0) / tangent_of(30.0), "turned");
}

TEST(LimitAnalysis, CohesionActsOnTheWholeJoint) {
  // F = (W cos a tan phi + c A)/(W sin a), of a block 2 x 1 x 0.5.
  const double weight = rock.density * g;
  for (const auto& [alpha, phi, cohesion] :
       {std::array{30.0, 25.0, 4e3}, {50.0, 20.0, 1e4}, {40.0, 0.0, 1e4}}) {
    for (const int order : {0, 1}) {
      const double slope = std::atan(tangent_of(alpha));
      const double factor =
          (weight * std::cos(slope) * tangent_of(phi) + 2.0 * cohesion) / (weight * std::sin(slope));
      expect_factors(on_slope(alpha, joint(tangent_of(phi), cohesion), order).safety(), factor,
                     std::to_string(alpha) + " " + std::to_string(order));
    }
  }
}

TEST(LimitAnalysis, ASearchEndsWhenItIsTold) {
  int trials = 0;
  LimitAnalysis analysis = on_slope(30.0, joint(0.7), 0).analysis();
  const LimitAnswer answer = analysis.strength_factor({0.1, 10.0, 1e-6}, [&] { return ++trials <= 2; });
  EXPECT_TRUE(answer.interrupted);
  EXPECT_EQ(answer.trials.size(), 2U);
  EXPECT_FALSE(answer.associated.resolved);
}

TEST(LimitAnalysis, AFactorOutsideTheSearchHasOneEnd) {
  LimitAnalysis analysis = on_slope(30.0, joint(tangent_of(35.0)), 0).analysis();
  const LimitAnswer above = analysis.strength_factor({0.1, 1.1, 1e-2}, [] { return true; });
  for (const LimitBracket& bracket : {above.associated, above.released}) {
    EXPECT_TRUE(bracket.resolved);
    EXPECT_EQ(bracket.lower, 1.1);
    EXPECT_FALSE(bracket.upper);
  }
  const LimitAnswer below = analysis.strength_factor({1.5, 10.0, 1e-2}, [] { return true; });
  for (const LimitBracket& bracket : {below.associated, below.released}) {
    EXPECT_TRUE(bracket.resolved);
    EXPECT_EQ(bracket.upper, 1.5);
    EXPECT_FALSE(bracket.lower);
  }
}

TEST(LimitAnalysis, ABlockThatTouchesNothingFalls) {
  Scene scene = on_slope(10.0, joint(0.5), 0);
  const int above = scene.add("above", Polyhedron(make_box({-0.5, -0.5, 3}, {0.5, 0.5, 4})));
  EXPECT_EQ(scene.build().rigid_model(1.0).bodies.size(), 2U);
  // Its factor is below any: it falls with g.
  LimitAnalysis analysis = scene.analysis();
  const LimitTrial trial = analysis.associated({});
  EXPECT_EQ(trial.outcome, LimitOutcome::moves);
  const LimitMotion motion = analysis.motion_of(trial);
  EXPECT_EQ(motion.mode, "falls");
  ASSERT_EQ(motion.blocks.size(), 1U);
  EXPECT_EQ(motion.blocks[0].block, above);
  EXPECT_LT((motion.blocks[0].acceleration - Vector3(0, 0, -g)).norm(), 1e-4 * g);
  EXPECT_LT(motion.blocks[0].angular_acceleration.norm(), 1e-4);
}

TEST(LimitAnalysis, TiedBlocksAreOneBody) {
  // Two cubes on each other on a slope topple at 1/2, one slides first.
  Scene scene;
  scene.law = joint(0.6);
  const double incline = std::atan(0.52) * 180.0 / std::numbers::pi;
  scene.add("lower", tilted_box({0, 0, 0}, {1, 1, 1}, incline), 1);
  scene.add("upper", tilted_box({0, 0, 1}, {1, 1, 2}, incline), 1);
  scene.add_fixed(tilted_box({-6, -2, -1}, {6, 2, 0}, incline));
  LimitAnalysis loose = scene.analysis();
  EXPECT_EQ(loose.model().bodies.size(), 2U);
  scene.ties.push_back({0, 1, 1e14});
  LimitAnalysis tied = scene.analysis();
  ASSERT_EQ(tied.model().bodies.size(), 1U);
  EXPECT_EQ(tied.model().bodies[0].blocks, (std::vector<int>{0, 1}));
  EXPECT_NEAR(tied.model().bodies[0].mass, 2.0 * rock.density, 1e-8 * rock.density);
  EXPECT_EQ(tied.model().body_of, (std::vector<int>{0, 0, -1}));
  const LimitTrial trial = tied.released({});
  EXPECT_EQ(trial.outcome, LimitOutcome::moves);
  const LimitMotion motion = tied.motion_of(trial);
  EXPECT_EQ(motion.mode, "topples");
  ASSERT_EQ(motion.blocks.size(), 2U);
  // About the edge: m g (h sin - b cos)/2 over m (b^2 + h^2)/3, b = 1, h = 2.
  const double slope = std::atan(0.52);
  const double expected = g * (2.0 * std::sin(slope) - std::cos(slope)) / 2.0 / (5.0 / 3.0);
  for (const LimitMotion::Block& block : motion.blocks)
    EXPECT_NEAR(block.angular_acceleration.norm() / expected, 1.0, 1e-3);
}

TEST(LimitAnalysis, ASupportLeavesWhatItLeaves) {
  // Held across x on its top face, a block may only move along x: a push of which friction in its joint resists 0.5 W.
  Scene scene;
  const int block = scene.add("A", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), 1);
  scene.add_fixed(Polyhedron(make_box({1, -1, -1}, {2, 2, 2})));
  scene.blocks[static_cast<std::size_t>(block)].supports.push_back(
      {Plane{{0, 0, 1}, Vector3::UnitZ()}, {false, true, true}, {}});
  for (const double push : {-1.0, 1.0}) {
    scene.gravity = {push, 0.0, -g};
    LimitAnalysis analysis = scene.analysis();
    ASSERT_EQ(analysis.model().bodies.size(), 1U);
    const RigidBody& body = analysis.model().bodies[0];
    EXPECT_EQ(body.freedom, 1);
    // One coordinate of unit mass: a translation along x.
    EXPECT_NEAR(std::abs(body.motion(0, 0)), 1.0, 1e-9);
    EXPECT_LT(body.motion.col(0).tail<5>().norm(), 1e-9);
    EXPECT_LT(body.motion.rightCols<5>().norm(), 1e-12);
    const LimitTrial trial = analysis.released({});
    EXPECT_EQ(trial.outcome, push > 0.0 ? LimitOutcome::stands : LimitOutcome::moves);
    if (push < 0.0) {
      const LimitMotion motion = analysis.motion_of(trial);
      ASSERT_EQ(motion.blocks.size(), 1U);
      EXPECT_LT((motion.blocks[0].acceleration - Vector3(push, 0, 0)).norm(), 1e-3);
    }
  }
}

TEST(LimitAnalysis, APushOfABlockIsBoundBySlidingAndToppling) {
  // mu W where the block slides, W b/(2 h) where it turns over the far edge first.
  for (const auto& [b, h, mode] : {std::tuple{1.0, 0.8, "slides on one plane"}, {1.0, 2.0, "topples"}}) {
    Scene scene;
    scene.law = joint(0.4);
    const int block = scene.add("A", Polyhedron(make_box({0, 0, 0}, {b, 1, h})));
    scene.add_fixed(Polyhedron(make_box({-3, -2, -1}, {4, 3, 0})));
    const double weight = rock.density * g * b * h;
    scene.blocks[static_cast<std::size_t>(block)].loads.push_back(
        {Vector3(0, 0.5, h), false, {0.1 * weight, 0, 0}, {}});
    LimitAnalysis analysis = scene.analysis({true, false});
    const LimitAnswer answer = analysis.load_factor({0.1, 100.0, 1e-3}, [] { return true; });
    expect_factors(answer, 10.0 * std::min(0.4, b / (2.0 * h)), mode);
    ASSERT_TRUE(answer.released.motion);
    EXPECT_EQ(analysis.motion_of(*answer.released.motion).mode, mode);
  }
}

// A square slab resists twisting by mu W times the mean distance of its base from the middle, a/6 (sqrt(2) + asinh(1)), if
// its pressure is uniform; corners alone would resist by 1.85 times that.
TEST(LimitAnalysis, ATwistedSlabResistsAsUniformPressureDoes) {
  for (const double side : {1.0, 3.0}) {
    Scene scene;
    scene.add("slab", Polyhedron(make_box({0, 0, 0}, {side, side, 0.2})));
    scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {side + 2, side + 2, 0})));
    for (const double end : {0.0, 1.0}) {
      const Vector3 corner(end * side, 0.5 * side, 0.1);
      scene.blocks[0].loads.push_back({corner, false, {0.0, (end - 0.5) * 2000.0, 0.0}, {}});
    }
    const LimitAnswer answer =
        scene.analysis({true, false}).load_factor({0.1, 1000.0, 1e-3}, [] { return true; });
    const double weight = rock.density * side * side * 0.2 * g;
    const double couple = 0.5 * weight * side / 6.0 * (std::sqrt(2.0) + std::asinh(1.0));
    expect_factors(answer, couple / (1000.0 * side), std::to_string(side));
  }
}

TEST(LimitAnalysis, AStoneBelowARoofMovesAwayFromIt) {
  // It slides down its plane and leaves the roof: tan(phi)/tan(45). Forces that wedge it below the roof balance it up
  // to 2.04: a linear programme of the plane problem gave 2.04024.
  const LimitAnswer answer = leaning_roof(0.5, 0.0).safety();
  expect_factor(answer.released, 0.5, 1e-3, "released");
  expect_factor(answer.associated, 2.0402, 1e-3, "associated");
  ASSERT_TRUE(answer.released.motion);
  LimitAnalysis analysis = leaning_roof(0.5, 0.0).analysis();
  const LimitMotion motion = analysis.motion_of(*answer.released.motion);
  EXPECT_EQ(motion.mode, "slides on one plane");
  ASSERT_EQ(motion.blocks.size(), 1U);
  EXPECT_EQ(motion.blocks[0].block, 2);
  const Vector3 down = Vector3(1, 0, -1).normalized();
  EXPECT_NEAR(motion.blocks[0].acceleration.normalized().dot(down), 1.0, 1e-6);
}

TEST(LimitAnalysis, JointsThatDilateByTheirFrictionAngleHaveOneLimit) {
  const LimitAnswer answer = leaning_roof(0.5, 0.5).safety();
  ASSERT_TRUE(answer.associated.lower && answer.associated.upper && answer.released.lower &&
              answer.released.upper);
  expect_factor(answer.associated, 2.0402, 1e-3, "associated");
  expect_factor(answer.released, 2.0402, 2e-3, "released");
}

/// A stack of three blocks beside a leaning one on a slope: many joints, no symmetry.
Scene heap() {
  Scene scene;
  scene.law = joint(0.7);
  constexpr double incline = 20.0;
  scene.add_fixed(tilted_box({-5, -3, -1}, {6, 3, 0}, incline));
  scene.add("A", tilted_box({0, 0, 0}, {1.5, 1, 0.6}, incline));
  scene.add("B", tilted_box({0.2, 0.1, 0.6}, {1.7, 1.1, 1.2}, incline));
  scene.add("C", tilted_box({-0.1, 0, 1.2}, {1.2, 0.8, 1.9}, incline));
  scene.add("D", tilted_box({1.5, 0, 0}, {2.4, 0.9, 0.6}, incline));
  return scene;
}

void expect_same(const LimitAnswer& a, const LimitAnswer& b, const std::string& what) {
  for (const auto& [x, y] : {std::pair{a.associated, b.associated}, {a.released, b.released}}) {
    ASSERT_TRUE(x.lower && x.upper && y.lower && y.upper) << what;
    EXPECT_NEAR(*x.lower / *y.lower, 1.0, 1e-6) << what;
    EXPECT_NEAR(*x.upper / *y.upper, 1.0, 1e-6) << what;
  }
}

TEST(LimitAnalysis, TheOrderOfBlocksIsOfNoMeaning) {
  for (const auto& [name, scene] : {std::pair{"heap", heap()}, {"roof", leaning_roof(0.5, 0.0)}}) {
    const LimitAnswer first = scene.safety(1e-2);
    std::vector<std::size_t> order(scene.blocks.size());
    std::iota(order.begin(), order.end(), 0U);
    std::reverse(order.begin(), order.end());
    expect_same(scene.reordered(order).safety(1e-2), first, std::string(name) + " reversed");
    std::rotate(order.begin(), order.begin() + 2, order.end());
    expect_same(scene.reordered(order).safety(1e-2), first, std::string(name) + " rotated");
  }
}

TEST(LimitAnalysis, AFactorHasNoUnit) {
  for (const auto& [name, scene] : {std::pair{"heap", heap()}, {"roof", leaning_roof(0.5, 0.0)}}) {
    const LimitAnswer first = scene.safety(1e-2);
    for (const double by : {1000.0, 0.001}) expect_same(scene.scaled(by).safety(1e-2), first, name);
  }
}

TEST(LimitAnalysis, AWedgeSlidesAlongTwoPlanes) {
  // Released, each plane transmits N = W cos(dip)/sqrt(2), all of its friction along the line: F = mu sqrt(2)/tan(dip).
  // Forces in balance may also press across the line, by s and N + s: 2 t = W sin(dip), t^2 + s^2 = mu^2 (N + s)^2. The
  // most t is N mu/sqrt(1 - mu^2), so that mu/F = k/sqrt(1 + k^2) with k = tan(dip)/sqrt(2).
  constexpr double mu = 0.6;
  const double k = tangent_of(35.0) / std::sqrt(2.0);
  const LimitAnswer answer = groove(35.0, mu).safety();
  expect_factor(answer.associated, mu * std::sqrt(1.0 + k * k) / k, 1e-3, "associated");
  expect_factor(answer.released, mu / k, 1e-3, "released");
}

}  // namespace
}  // namespace ashlar::limit_analysis_test

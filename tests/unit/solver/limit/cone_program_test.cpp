// Cone programmes whose answers are known by hand.
#include "solver/limit/cone_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace ashlar::cone_program_test {
namespace {

using Eigen::Vector3d;

BodyVelocity coordinates(double n, double t1 = 0.0, double t2 = 0.0) {
  BodyVelocity v = BodyVelocity::Zero();
  v.head<3>() << n, t1, t2;
  return v;
}

/// The first three coordinates of a body are its velocity along normal and tangents.
ConeRows unit_rows() {
  ConeRows rows = ConeRows::Zero();
  rows.leftCols<3>().setIdentity();
  return rows;
}

/// A body of three coordinates on the ground, at one point.
ConeProgram one_point(const ConeStrength& strength) {
  return ConeProgram({3}, {{{0, -1}, 0, 1}}, {{unit_rows(), ConeRows::Zero(), strength}}, 1);
}

ConeAnswer at_rest(ConeProgram& program, std::vector<BodyVelocity> load, std::vector<double> shift = {}) {
  ConeQuestion question;
  question.load = std::move(load);
  question.shift = std::move(shift);
  ConeAnswer answer = program.solve(question);
  EXPECT_EQ(answer.status, ConeStatus::solved);
  return answer;
}

ConeAnswer at_rest(const ConeStrength& strength, const BodyVelocity& load, std::vector<double> shift = {}) {
  ConeProgram program = one_point(strength);
  return at_rest(program, {load}, std::move(shift));
}

/// Rest is known to the root of its gap.
constexpr double of_rest = 2e-6;

void expect_near(const BodyVelocity& found, const BodyVelocity& expected, double tolerance = of_rest) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose() << " for " << expected.transpose();
}

void expect_near(const Vector3d& found, const Vector3d& expected, double tolerance = of_rest) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose() << " for " << expected.transpose();
}

TEST(ConeProgram, FrictionHoldsUpToItsAngle) {
  constexpr double mu = 0.6;
  for (const double q : {0.0, 0.3, 0.59}) {
    const ConeAnswer answer = at_rest({mu, 0.0, 0.0}, coordinates(-1.0, q));
    expect_near(answer.velocity[0], BodyVelocity::Zero());
    expect_near(answer.force[0], {1.0, -q, 0.0});
  }
}

TEST(ConeProgram, ABarHasBoundsOfTensionAndCompression) {
  // The force opposes the load up to the bound on its side; shear is not resisted.
  constexpr double none = std::numeric_limits<double>::infinity();
  for (const auto& [strength, load, force] : {
           std::tuple{ConeStrength{0.0, 0.0, 0.7, 0.0}, 0.5, -0.5},
           {ConeStrength{0.0, 0.0, 0.7, 0.0}, 1.0, -0.7},
           {ConeStrength{0.0, 0.0, 0.7, 0.0}, -1.0, 0.0},
           {ConeStrength{0.0, 0.0, 0.7, 0.4}, -1.0, 0.4},
           {ConeStrength{0.0, 0.0, 0.0, 0.4}, 1.0, 0.0},
           {ConeStrength{0.0, 0.0, none, 0.0}, 3.0, -3.0},
           {ConeStrength{0.0, 0.0, none, none}, -2.0, 2.0},
       }) {
    const ConeAnswer answer = at_rest(strength, coordinates(load, 0.25));
    expect_near(answer.force[0], {force, 0.0, 0.0});
    expect_near(answer.velocity[0], coordinates(load + force, 0.25));
  }
}

TEST(ConeProgram, ADowelHasABoundOfShearOnly) {
  const ConeAnswer answer = at_rest({0.0, 0.5, 0.2, 0.1}, coordinates(-1.0, 0.6, -0.8));
  expect_near(answer.force[0], {0.1, -0.3, 0.4});
  expect_near(answer.velocity[0], coordinates(-0.9, 0.3, -0.4));
}

TEST(ConeProgram, BeyondItsAngleTheForceIsTheNearestOfTheCone) {
  // The projection of (1, -q) on the ray (1, -mu) is at l = (1 + mu q)/(1 + mu^2). The rest of the load,
  // (mu, 1)(q - mu)/(1 + mu^2), opens by mu times what it slides.
  constexpr double mu = 0.6;
  for (const double q : {0.61, 0.9, 5.0}) {
    const ConeAnswer answer = at_rest({mu, 0.0, 0.0}, coordinates(-1.0, q));
    const double l = (1.0 + mu * q) / (1.0 + mu * mu), v = (q - mu) / (1.0 + mu * mu);
    expect_near(answer.force[0], {l, -mu * l, 0.0});
    expect_near(answer.velocity[0], coordinates(mu * v, v));
    EXPECT_NEAR(answer.opening[0][0], v, of_rest);
  }
}

TEST(ConeProgram, FrictionActsAlongAnyTangent) {
  constexpr double mu = 0.5;
  const Eigen::Vector2d along(std::cos(1.1), std::sin(1.1));
  const ConeAnswer answer = at_rest({mu, 0.0, 0.0}, coordinates(-1.0, 0.8 * along[0], 0.8 * along[1]));
  const double v = (0.8 - mu) / (1.0 + mu * mu);
  expect_near(answer.velocity[0], coordinates(mu * v, v * along[0], v * along[1]));
}

TEST(ConeProgram, AShiftOfWhatFrictionOpensIsCoulombsLaw) {
  // With v = (0, q - mu) the point opens by mu |v_t| less the shift, which is nothing, and N = 1.
  constexpr double mu = 0.6;
  for (const double q : {0.7, 2.0}) {
    const ConeAnswer answer = at_rest({mu, 0.0, 0.0}, coordinates(-1.0, q), {mu * (q - mu)});
    expect_near(answer.velocity[0], coordinates(0.0, q - mu));
    expect_near(answer.force[0], {1.0, -mu, 0.0});
  }
}

TEST(ConeProgram, SlowSlipSinksIntoItsShiftWhereFrictionHolds) {
  // Residual leaves one force, inside of the cone: the point may neither slide nor open, v_n + s = 0.
  ConeProgram program = one_point({0.6, 0.0, 0.0});
  ConeQuestion question;
  question.load = {coordinates(-1.0, 0.3)};
  question.balanced = true;
  question.shift = {1.0};
  const ConeAnswer answer = program.solve(question);
  EXPECT_EQ(answer.status, ConeStatus::solved);
  expect_near(answer.force[0], {1.0, -0.3, 0.0});
  expect_near(answer.velocity[0], coordinates(-1.0));
}

TEST(ConeProgram, ABodyThatIsPulledFliesOff) {
  const ConeAnswer answer = at_rest({0.6, 0.0, 0.0}, coordinates(1.0, 0.2));
  expect_near(answer.velocity[0], coordinates(1.0, 0.2));
  expect_near(answer.force[0], Vector3d::Zero());
}

TEST(ConeProgram, TheFactorOfAPushIsFriction) {
  // The mechanism has F1 . v = v_t = 1 and opens by mu.
  for (const double mu : {0.05, 0.6, 1.7}) {
    ConeProgram program = one_point({mu, 0.0, 0.0});
    ConeQuestion question;
    question.load = {coordinates(-1.0)};
    question.grows = {coordinates(0.0, 1.0)};
    question.most = 10.0;
    const ConeAnswer answer = program.solve(question);
    EXPECT_EQ(answer.status, ConeStatus::solved);
    EXPECT_NEAR(answer.factor, mu, 1e-6);
    EXPECT_NEAR(answer.velocity[0][1], 1.0, 1e-5);
    EXPECT_NEAR(answer.velocity[0][0], mu, 1e-5);
    expect_near(answer.force[0], {1.0, -mu, 0.0});
    EXPECT_LT(answer.residual, 1e-6);
  }
}

TEST(ConeProgram, AFactorThatNothingLimitsIsTheMost) {
  ConeProgram program = one_point({0.6, 0.0, 0.0});
  ConeQuestion question;
  question.load = {coordinates(-1.0)};
  question.grows = {coordinates(-1.0)};
  for (const double most : {1.0, 7.5, 1e3}) {
    question.most = most;
    const ConeAnswer answer = program.solve(question);
    EXPECT_EQ(answer.status, ConeStatus::solved);
    EXPECT_NEAR(answer.factor / most, 1.0, 1e-6);
    EXPECT_NEAR(answer.force[0][0] / (1.0 + most), 1.0, 1e-6);
  }
}

TEST(ConeProgram, APullIsBorneUpToTensionOrTheApexOfTheCone) {
  // |t| <= c + mu N leaves nothing beyond N = -c/mu.
  for (const ConeStrength& strength :
       {ConeStrength{0.5, 0.4, 0.3}, {0.5, 0.4, 0.8}, {0.5, 0.4, 2.0}, {2.0, 0.1, 0.0}}) {
    const double most = std::min(strength.tension, strength.cohesion / strength.friction);
    if (most > 0.0) {
      const ConeAnswer stands = at_rest(strength, coordinates(0.98 * most));
      expect_near(stands.velocity[0], BodyVelocity::Zero());
      expect_near(stands.force[0], {-0.98 * most, 0.0, 0.0});
    }
    const ConeAnswer moves = at_rest(strength, coordinates(most + 0.7));
    expect_near(moves.velocity[0], coordinates(0.7));
    expect_near(moves.force[0], {-most, 0.0, 0.0});
  }
}

TEST(ConeProgram, CohesionAddsToFriction) {
  // Pressed by 1, c + mu is borne; pulled by 0.2, c - 0.2 mu.
  const ConeStrength strength{0.5, 0.4, 0.3};
  for (const auto& [press, bears] : {std::pair{1.0, 0.9}, {-0.2, 0.3}}) {
    const ConeAnswer stands = at_rest(strength, coordinates(-press, bears - 0.01));
    expect_near(stands.velocity[0], BodyVelocity::Zero());
    const ConeAnswer moves = at_rest(strength, coordinates(-press, bears + 0.01));
    EXPECT_NEAR(moves.velocity[0][1], 0.01 / 1.25, of_rest);
    EXPECT_NEAR(moves.velocity[0][0], 0.5 * moves.velocity[0][1], of_rest);
  }
}

TEST(ConeProgram, CohesionWithoutFrictionBearsTheSameAtAnyNormalForce) {
  const ConeStrength strength{0.0, 0.4, 0.3};
  for (const double press : {2.0, 0.0, -0.29}) {
    const ConeAnswer stands = at_rest(strength, coordinates(-press, 0.39));
    expect_near(stands.velocity[0], BodyVelocity::Zero());
    const ConeAnswer moves = at_rest(strength, coordinates(-press, 0.5));
    expect_near(moves.velocity[0], coordinates(0.0, 0.1));
    expect_near(moves.force[0], {press, -0.4, 0.0});
  }
  const ConeAnswer torn = at_rest(strength, coordinates(0.5, 0.5));
  expect_near(torn.velocity[0], coordinates(0.2, 0.1));
  EXPECT_NEAR(torn.opening[0][1], 0.2, of_rest);
}

TEST(ConeProgram, NothingHoldsASmoothPointAlongItsTangents) {
  const ConeAnswer slides = at_rest({0.0, 0.0, 0.0}, coordinates(-1.0, 0.3, -0.1));
  expect_near(slides.velocity[0], coordinates(0.0, 0.3, -0.1));
  expect_near(slides.force[0], {1.0, 0.0, 0.0});
  // It may be glued all the same.
  const ConeAnswer glued = at_rest({0.0, 0.0, 0.5}, coordinates(0.8, 0.3));
  expect_near(glued.velocity[0], coordinates(0.3, 0.3));
}

/// Body 0 on the ground, body 1 on body 0.
ConeProgram two_stacked(const ConeStrength& strength) {
  return ConeProgram({3, 3}, {{{0, -1}, 0, 1}, {{1, 0}, 1, 2}},
                     {{unit_rows(), ConeRows::Zero(), strength}, {unit_rows(), unit_rows(), strength}}, 1);
}

TEST(ConeProgram, TheUpperOfTwoBodiesSlidesOnTheLower) {
  // The lower one is pressed by 1 + l and pushed by mu l, which is within its friction.
  constexpr double mu = 0.6, q = 0.9;
  ConeProgram program = two_stacked({mu, 0.0, 0.0});
  const ConeAnswer answer = at_rest(program, {coordinates(-1.0), coordinates(-1.0, q)});
  const double l = (1.0 + mu * q) / (1.0 + mu * mu), v = (q - mu) / (1.0 + mu * mu);
  expect_near(answer.velocity[0], BodyVelocity::Zero());
  expect_near(answer.velocity[1], coordinates(mu * v, v));
  expect_near(answer.force[0], {1.0 + l, -mu * l, 0.0});
  expect_near(answer.force[1], {l, -mu * l, 0.0});
  expect_near(program.relative(1, 1, answer.velocity), {mu * v, v, 0.0});
}

TEST(ConeProgram, TheLowerOfTwoBodiesBearsBoth) {
  constexpr double q = 0.5;
  ConeProgram program = two_stacked({0.6, 0.0, 0.0});
  const ConeAnswer answer = at_rest(program, {coordinates(-1.0), coordinates(-1.0, q)});
  expect_near(answer.velocity[0], BodyVelocity::Zero());
  expect_near(answer.velocity[1], BodyVelocity::Zero());
  expect_near(answer.force[0], {2.0, -q, 0.0});
  expect_near(answer.force[1], {1.0, -q, 0.0});
}

TEST(ConeProgram, BodiesOfAPairMayComeInEitherOrder) {
  // The same stack seen from below: body 0 is the first of its pair with body 1, and forces on it are opposite.
  constexpr double mu = 0.6, q = 0.9;
  ConeProgram program(
      {3, 3}, {{{0, -1}, 0, 1}, {{0, 1}, 1, 2}},
      {{unit_rows(), ConeRows::Zero(), {mu, 0.0, 0.0}}, {-unit_rows(), -unit_rows(), {mu, 0.0, 0.0}}}, 1);
  const ConeAnswer answer = at_rest(program, {coordinates(-1.0), coordinates(-1.0, q)});
  const double v = (q - mu) / (1.0 + mu * mu);
  expect_near(answer.velocity[0], BodyVelocity::Zero());
  expect_near(answer.velocity[1], coordinates(mu * v, v));
}

TEST(ConeProgram, OneCoordinateMayMoveAlongSlopesOnly) {
  // Up a slope of the tangent k the body opens by k of what it slides. Friction above k holds it under any push:
  // N (k - mu) + f = 0 has a solution.
  for (const double k : {0.3, 0.59, 0.61, 2.0}) {
    const double length = std::hypot(1.0, k);
    ConeRows rows = ConeRows::Zero();
    rows(0, 0) = k / length;
    rows(1, 0) = 1.0 / length;
    ConeProgram program({1}, {{{0, -1}, 0, 1}}, {{rows, ConeRows::Zero(), {0.6, 0.0, 0.0}}}, 1);
    const ConeAnswer answer = at_rest(program, {coordinates(1.0)});
    expect_near(answer.velocity[0], coordinates(k < 0.6 ? 0.0 : 1.0));
  }
}

TEST(ConeProgram, WithoutLoadsNothingMoves) {
  const ConeAnswer answer = at_rest({0.6, 0.0, 0.0}, BodyVelocity::Zero());
  EXPECT_LT(answer.velocity[0].norm(), 1e-12);
  EXPECT_TRUE(answer.force[0].allFinite());
}

TEST(ConeProgram, WithoutPointsBodiesFall) {
  ConeProgram program({6, 2}, {}, {}, 1);
  BodyVelocity load;
  load << 1, -2, 3, -4, 5, -6;
  const ConeAnswer answer = at_rest(program, {load, coordinates(0.0, -1.0)});
  expect_near(answer.velocity[0], load, 1e-12);
  expect_near(answer.velocity[1], coordinates(0.0, -1.0), 1e-12);
}

TEST(ConeProgram, LoadsOfAnySizeHaveTheSameAnswer) {
  constexpr double mu = 0.6, q = 0.9;
  for (const double size : {1e-9, 1e9}) {
    const ConeAnswer answer = at_rest({mu, 0.0, 0.0}, size * coordinates(-1.0, q));
    const double v = (q - mu) / (1.0 + mu * mu);
    expect_near(answer.velocity[0] / size, coordinates(mu * v, v));
  }
}

}  // namespace
}  // namespace ashlar::cone_program_test

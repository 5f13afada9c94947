// Cone programmes whose answers are known by hand, and random ones whose conditions of optimality are checked.
#include "solver/statics/cone_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace ashlar {
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

TEST(ConeProgram, BeyondItsAngleTheForceIsTheNearestOfTheCone) {
  // The projection of (1, -q) on the ray (1, -mu) is at l = (1 + mu q)/(1 + mu^2). What is left of the load,
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
    EXPECT_LT(answer.lacking, 1e-6);
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
  // Up a slope of the tangent k the body opens by k of what it slides. Friction of more than k holds it whatever pushes:
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

/// Bodies in a chain that also touch the ground, with points of all kinds.
struct RandomProgramme {
  std::vector<int> freedom;
  std::vector<ConePair> pairs;
  std::vector<ConePoint> points;
  std::vector<BodyVelocity> load;   ///< random
  std::vector<BodyVelocity> borne;  ///< some that forces within the strengths balance
  std::vector<double> shift;

  RandomProgramme(unsigned seed, int bodies, int points_of_pair) : random_(seed) {
    for (int b = 0; b < bodies; ++b) freedom.push_back(b % 4 == 3 ? 3 : 6);
    load.assign(freedom.size(), BodyVelocity::Zero());
    borne = load;
    for (int b = 0; b < bodies; ++b) {
      load[static_cast<std::size_t>(b)].head(freedom[static_cast<std::size_t>(b)]) =
          vector(6).head(freedom[static_cast<std::size_t>(b)]);
      if (b > 0) add(b, b - 1, points_of_pair);
      if (b % 4 == 0) add(b, -1, points_of_pair);
    }
  }

  [[nodiscard]] ConeProgram program(int threads) const { return {freedom, pairs, points, threads}; }

 private:
  double number() { return std::normal_distribution<double>()(random_); }
  Eigen::VectorXd vector(int size) {
    return Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return number(); });
  }
  ConeRows rows(int body) {
    ConeRows rows = ConeRows::Zero();
    if (body < 0) return rows;
    for (int k = 0; k < freedom[static_cast<std::size_t>(body)]; ++k) rows.col(k) = vector(3);
    return rows;
  }
  void add(int a, int b, int count) {
    const std::size_t begin = points.size();
    for (int k = 0; k < count; ++k) {
      ConePoint point{rows(a), rows(b), {}};
      const std::size_t kind = points.size() % 5;
      const double mu = 0.05 + 0.2 * std::abs(number()), c = 0.02 + 0.2 * std::abs(number());
      point.strength = std::array<ConeStrength, 5>{
          ConeStrength{mu, 0, 0}, {mu, c, 0.3 * c / mu}, {mu, c, 9 * c / mu}, {0, c, c}, {0, 0, 0}}[kind];
      // Half of what the point bears at a random normal force.
      const ConeStrength& s = point.strength;
      const double normal = std::abs(number());
      Vector3d force(normal, number(), number());
      force.tail<2>() *= 0.5 * (s.cohesion + s.friction * normal) / force.tail<2>().norm();
      borne[static_cast<std::size_t>(a)] -= point.first.transpose() * force;
      if (b >= 0) borne[static_cast<std::size_t>(b)] += point.second.transpose() * force;
      shift.push_back(kind == 1 ? 0.0 : 0.3 * std::abs(number()));
      points.push_back(point);
    }
    pairs.push_back({{a, b}, begin, points.size()});
  }

  std::mt19937_64 random_;
};

/// What an answer lacks at being one: balance, strength, flow.
struct Lacking {
  double balance = 0.0;
  double strength = 0.0;  ///< by which forces exceed it
  double flow = 0.0;      ///< opening less than mu times sliding
  double work = 0.0;      ///< of forces beside the least that the strength has in this motion
};

/// @param rest of `rest` v is what is left of the loads, else nothing is
Lacking lacking(const RandomProgramme& of, const ConeAnswer& answer, std::vector<BodyVelocity> loads,
                const std::vector<double>& shift, bool rest) {
  Lacking most;
  const auto body = [](int b) { return static_cast<std::size_t>(b); };
  for (const ConePair& pair : of.pairs) {
    const auto [a, b] = pair.bodies;
    for (std::size_t k = pair.begin; k < pair.end; ++k) {
      const ConePoint& point = of.points[k];
      const ConeStrength& s = point.strength;
      const Vector3d& p = answer.force[k];
      Vector3d y = point.first * answer.velocity[body(a)];
      if (b >= 0) y -= point.second * answer.velocity[body(b)];
      loads[body(a)] += point.first.transpose() * p;
      if (b >= 0) loads[body(b)] -= point.second.transpose() * p;
      const double opens = y[0] + (shift.empty() ? 0.0 : shift[k]);
      const double slides = s.shear() ? y.tail<2>().norm() : 0.0;
      most.strength =
          std::max({most.strength, p.tail<2>().norm() - s.cohesion - s.friction * p[0], -s.tension - p[0]});
      most.flow = std::max(most.flow, s.friction * slides - opens);
      // N opens + t . y_t is least with t against the sliding and N as small as it may be.
      const double least_normal =
          -(s.friction > 0.0 ? std::min(s.tension, s.cohesion / s.friction) : s.tension);
      const double least = (opens - s.friction * slides) * least_normal - s.cohesion * slides;
      most.work += std::abs(p[0] * opens + p.tail<2>().dot(y.tail<2>()) - least);
    }
  }
  for (std::size_t b = 0; b < loads.size(); ++b)
    most.balance =
        std::max(most.balance, (loads[b] - (rest ? answer.velocity[b] : BodyVelocity::Zero())).norm());
  return most;
}

TEST(ConeProgram, RandomRestMeetsAllConditions) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    const RandomProgramme of(seed, 8, 5);
    ASSERT_EQ(of.pairs.size(), 9U);
    ASSERT_EQ(of.points.size(), 45U);
    for (const bool shifted : {false, true}) {
      ConeQuestion question;
      question.load = of.load;
      if (shifted) question.shift = of.shift;
      const ConeAnswer answer = of.program(1).solve(question);
      EXPECT_EQ(answer.status, ConeStatus::solved) << seed;
      const Lacking lacks = lacking(of, answer, question.load, question.shift, true);
      EXPECT_LT(lacks.balance, 1e-7) << seed;
      EXPECT_LT(lacks.strength, 1e-7) << seed;
      EXPECT_LT(lacks.flow, 1e-7) << seed;
      double square = 0.0, fastest = 0.0;
      for (const BodyVelocity& load : of.load) square += load.squaredNorm();
      for (const BodyVelocity& v : answer.velocity) fastest = std::max(fastest, v.norm());
      EXPECT_GT(fastest, 0.1) << seed;
      EXPECT_LT(lacks.work, 1e-7 * square) << seed;
    }
  }
}

TEST(ConeProgram, RandomFactorMeetsAllConditions) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    const RandomProgramme of(seed, 8, 5);
    ConeQuestion question;
    question.load = of.borne;
    question.grows = of.load;
    question.most = 1e3;
    const ConeAnswer answer = of.program(1).solve(question);
    EXPECT_EQ(answer.status, ConeStatus::solved) << seed;
    EXPECT_GT(answer.factor, 0.0) << seed;
    double growth = 0.0, fastest = 0.0, largest = 1.0;
    std::vector<BodyVelocity> loads = of.borne;
    for (std::size_t b = 0; b < loads.size(); ++b) {
      loads[b] += answer.factor * of.load[b];
      growth += of.load[b].dot(answer.velocity[b]);
      fastest = std::max(fastest, answer.velocity[b].norm());
      largest = std::max(largest, loads[b].norm());
    }
    const Lacking lacks = lacking(of, answer, loads, {}, false);
    EXPECT_LT(lacks.balance / largest, 1e-7) << seed;
    EXPECT_LT(lacks.strength / largest, 1e-7) << seed;
    if (answer.factor < 0.999 * question.most) {
      EXPECT_NEAR(growth, 1.0, 1e-6) << seed;
      EXPECT_LT(lacks.flow / fastest, 1e-7) << seed;
      EXPECT_LT(lacks.work, 1e-6 * std::max(1.0, answer.factor) * largest) << seed;
    }
  }
}

bool same_bits(const ConeAnswer& a, const ConeAnswer& b) {
  return a.velocity == b.velocity && a.force == b.force && a.opening == b.opening && a.factor == b.factor &&
         a.gap == b.gap && a.lacking == b.lacking && a.iterations == b.iterations && a.status == b.status;
}

TEST(ConeProgram, AnswersDependOnTheQuestionOnly) {
  // More points than one thread is given.
  const RandomProgramme of(11, 60, 10);
  ASSERT_GT(of.points.size(), 500U);
  ConeQuestion rest;
  rest.load = of.load;
  ConeQuestion shifted = rest;
  shifted.shift = of.shift;
  ConeQuestion factor;
  factor.load = of.borne;
  factor.grows = of.load;
  factor.most = 50.0;
  ConeProgram one = of.program(1), four = of.program(4);
  const ConeAnswer first = one.solve(rest), second = one.solve(factor);
  EXPECT_EQ(first.status, ConeStatus::solved);
  EXPECT_EQ(second.status, ConeStatus::solved);
  EXPECT_TRUE(same_bits(four.solve(factor), second));
  static_cast<void>(four.solve(shifted));
  EXPECT_TRUE(same_bits(four.solve(rest), first));
  // Strengths that came and went leave nothing behind either.
  const ConeStrength was = one.points()[7].strength;
  one.set_strength(7, {3.0, 1.0, 0.1});
  EXPECT_FALSE(same_bits(one.solve(rest), first));
  one.set_strength(7, was);
  EXPECT_TRUE(same_bits(one.solve(rest), first));
}

}  // namespace
}  // namespace ashlar

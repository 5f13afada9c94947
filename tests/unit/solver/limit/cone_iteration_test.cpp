// Random cone programmes whose conditions of optimality are checked.
#include "solver/limit/cone_iteration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "solver/limit/cone_program.hpp"

namespace ashlar::cone_iteration_test {
namespace {

using Eigen::Vector3d;

/// Bodies in a chain that also touch the ground, with points of all kinds.
struct RandomProgramme {
  std::vector<int> freedom;
  std::vector<ConePair> pairs;
  std::vector<ConePoint> points;
  std::vector<BodyVelocity> load;   ///< random
  std::vector<BodyVelocity> borne;  ///< some that forces within the strengths balance
  std::vector<double> shift;

  /// @param bars true: points with bounds of bars in place of contacts, but for each fifth one
  RandomProgramme(unsigned seed, int bodies, int points_of_pair, bool bars = false)
      : bars_(bars), random_(seed) {
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
      // Half of the strength of the point at a random normal force.
      if (bars_ && kind > 0)
        point.strength = std::array<ConeStrength, 5>{
            ConeStrength{}, {0, 0, c, 0}, {0, c, c, 2 * c}, {0, 0, none, 0.5 * c}, {0, c, none, none}}[kind];
      const ConeStrength& s = point.strength;
      const double normal = std::clamp(std::abs(number()), 0.0, s.compression);
      Vector3d force(normal, number(), number());
      force.tail<2>() *= 0.5 * (s.cohesion + s.friction * normal) / force.tail<2>().norm();
      borne[static_cast<std::size_t>(a)] -= point.first.transpose() * force;
      if (b >= 0) borne[static_cast<std::size_t>(b)] += point.second.transpose() * force;
      shift.push_back(kind == 1 ? 0.0 : 0.3 * std::abs(number()));
      points.push_back(point);
    }
    pairs.push_back({{a, b}, begin, points.size()});
  }

  static constexpr double none = std::numeric_limits<double>::infinity();
  bool bars_;
  std::mt19937_64 random_;
};

/// Residuals of an answer: balance, strength, flow.
struct Lacking {
  double balance = 0.0;
  double strength = 0.0;  ///< by which forces exceed it
  double flow = 0.0;      ///< opening less than mu times sliding
  double work = 0.0;      ///< of forces beside the least that the strength has in this motion
};

/// @param rest if true, `rest` v remains of the loads, else nothing
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
      most.strength = std::max({most.strength, p.tail<2>().norm() - s.cohesion - s.friction * p[0],
                                -s.tension - p[0], p[0] - s.compression});
      if (!s.crushes()) most.flow = std::max(most.flow, s.friction * slides - opens);
      if (std::isinf(s.tension)) most.flow = std::max(most.flow, opens);
      // N opens + t . y_t is least with t against the sliding and N as small as it may be.
      double least_normal = -(s.friction > 0.0 ? std::min(s.tension, s.cohesion / s.friction) : s.tension);
      if (s.crushes() && opens < 0.0) least_normal = s.compression;
      if (std::isinf(least_normal)) least_normal = p[0];
      const double least = (opens - s.friction * slides) * least_normal - s.cohesion * slides;
      most.work += std::abs(p[0] * opens + p.tail<2>().dot(y.tail<2>()) - least);
    }
  }
  for (std::size_t b = 0; b < loads.size(); ++b)
    most.balance =
        std::max(most.balance, (loads[b] - (rest ? answer.velocity[b] : BodyVelocity::Zero())).norm());
  return most;
}

TEST(ConeIteration, RandomRestWithBarsMeetsAllConditions) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const RandomProgramme of(seed, 8, 5, true);
    ConeQuestion question;
    question.load = of.load;
    const ConeAnswer answer = of.program(1).solve(question);
    EXPECT_EQ(answer.status, ConeStatus::solved) << seed;
    const Lacking residual = lacking(of, answer, question.load, {}, true);
    double square = 0.0, fastest = 0.0;
    for (const BodyVelocity& load : of.load) square += load.squaredNorm();
    for (const BodyVelocity& v : answer.velocity) fastest = std::max(fastest, v.norm());
    EXPECT_GT(fastest, 0.1) << seed;
    EXPECT_LT(residual.balance, 1e-7) << seed;
    EXPECT_LT(residual.strength, 1e-7) << seed;
    EXPECT_LT(residual.flow, 1e-7) << seed;
    EXPECT_LT(residual.work, 1e-7 * square) << seed;
  }
}

TEST(ConeIteration, RandomRestMeetsAllConditions) {
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
      const Lacking residual = lacking(of, answer, question.load, question.shift, true);
      EXPECT_LT(residual.balance, 1e-7) << seed;
      EXPECT_LT(residual.strength, 1e-7) << seed;
      EXPECT_LT(residual.flow, 1e-7) << seed;
      double square = 0.0, fastest = 0.0;
      for (const BodyVelocity& load : of.load) square += load.squaredNorm();
      for (const BodyVelocity& v : answer.velocity) fastest = std::max(fastest, v.norm());
      EXPECT_GT(fastest, 0.1) << seed;
      EXPECT_LT(residual.work, 1e-7 * square) << seed;
    }
  }
}

TEST(ConeIteration, RandomFactorMeetsAllConditions) {
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
    const Lacking residual = lacking(of, answer, loads, {}, false);
    EXPECT_LT(residual.balance / largest, 1e-7) << seed;
    EXPECT_LT(residual.strength / largest, 1e-7) << seed;
    if (answer.factor < 0.999 * question.most) {
      EXPECT_NEAR(growth, 1.0, 1e-6) << seed;
      EXPECT_LT(residual.flow / fastest, 1e-7) << seed;
      EXPECT_LT(residual.work, 1e-6 * std::max(1.0, answer.factor) * largest) << seed;
    }
  }
}

bool same_bits(const ConeAnswer& a, const ConeAnswer& b) {
  return a.velocity == b.velocity && a.force == b.force && a.opening == b.opening && a.factor == b.factor &&
         a.gap == b.gap && a.residual == b.residual && a.iterations == b.iterations && a.status == b.status;
}

TEST(ConeIteration, AnswersDependOnTheQuestionOnly) {
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
}  // namespace ashlar::cone_iteration_test

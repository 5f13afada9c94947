#include "mechanics/basis/quadrature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "mechanics/basis/moments.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::quadrature_test {
namespace {

double integrate(const SegmentRule& rule, int power) {
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.points.size(); ++k)
    sum += rule.weights[k] * std::pow(rule.points[k], power);
  return sum;
}

TEST(Quadrature, SegmentRulesAreExactToTheirDegree) {
  for (int count = 1; count <= 10; ++count) {
    for (int k = 0; k <= 2 * count - 1; ++k)
      EXPECT_NEAR(integrate(gauss_legendre(count), k), 1.0 / (k + 1), 1e-14);
    for (int k = 0; k <= 2 * count - 2; ++k) {
      EXPECT_NEAR(integrate(radau_for_triangles(count), k), 1.0 / ((k + 1) * (k + 2)), 1e-14)
          << count << ' ' << k;
    }
    EXPECT_EQ(radau_for_triangles(count).points.front(), 0.0);
    if (count < 2) continue;
    const SegmentRule lobatto = gauss_lobatto(count);
    for (int k = 0; k <= 2 * count - 3; ++k) EXPECT_NEAR(integrate(lobatto, k), 1.0 / (k + 1), 1e-14);
    EXPECT_EQ(lobatto.points.front(), 0.0);
    EXPECT_EQ(lobatto.points.back(), 1.0);
  }
}

TEST(Quadrature, SimpsonIsTheThreePointLobattoRule) {
  const SegmentRule rule = gauss_lobatto(3);
  EXPECT_NEAR(rule.weights[0], 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(rule.weights[1], 4.0 / 6.0, 1e-15);
  EXPECT_NEAR(rule.points[1], 0.5, 1e-15);
}

// Over [0,2]x[0,1] with the corner (2,1) cut off from (2,0.5) to (1,1): the square's integral less the
// triangle's.
double pentagon_integral(int a, int b) {
  double triangle = 0.0;  // (1,1) + s (1,0) over 0 <= s <= 1, below it from 1 - s/2 to 1
  const SegmentRule line = gauss_legendre(20);
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    const double s = line.points[k];
    triangle += line.weights[k] * std::pow(1 + s, a) * (1.0 - std::pow(1.0 - 0.5 * s, b + 1)) / (b + 1);
  }
  return std::pow(2.0, a + 1) / (a + 1) / (b + 1) - triangle;
}

TEST(Quadrature, PolygonRuleIsExactPositiveAndHoldsTheCorners) {
  const std::vector<Eigen::Vector2d> pentagon = {{0, 0}, {2, 0}, {2, 0.5}, {1, 1}, {0, 1}};
  for (int degree = 1; degree <= 9; ++degree) {
    const PolygonRule rule = polygon_rule(pentagon, degree);
    for (int a = 0; a <= degree; ++a) {
      for (int b = 0; a + b <= degree; ++b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < rule.points.size(); ++k) {
          sum += rule.weights[k] * std::pow(rule.points[k].x(), a) * std::pow(rule.points[k].y(), b);
        }
        EXPECT_NEAR(sum, pentagon_integral(a, b), 1e-12 * std::pow(2.0, a)) << degree << a << b;
      }
    }
    for (const double weight : rule.weights) EXPECT_GT(weight, 0.0);
    for (const auto& corner : pentagon) {
      const bool found = std::any_of(rule.points.begin(), rule.points.end(),
                                     [&](const Eigen::Vector2d& p) { return (p - corner).norm() < 1e-15; });
      EXPECT_TRUE(found);
    }
  }
  EXPECT_TRUE(polygon_rule({{0, 0}, {1, 0}, {2, 0}}, 2).points.empty());
}

double integrate(const PolygonRule& rule, const std::function<double(const Eigen::Vector2d&)>& f) {
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.points.size(); ++k) sum += rule.weights[k] * f(rule.points[k]);
  return sum;
}

// Moments of a polygon about its first corner, by triangles: the integral of a product of two affine functions that are
// a_i in the corners of a triangle is  area / 12 (sum a_i b_i + sum a_i sum b_i).
TEST(Quadrature, AffineRuleIsExactForProductsOfAffineFunctions) {
  std::mt19937_64 random(20261127);
  const auto any = [&] { return 0x1p-53 * static_cast<double>(random() >> 11U); };
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<double> angles(static_cast<std::size_t>(3 + trial % 7));
    for (double& angle : angles) angle = 2.0 * std::numbers::pi * any();
    std::sort(angles.begin(), angles.end());
    std::vector<Eigen::Vector2d> polygon;
    for (const double angle : angles)
      polygon.emplace_back(Eigen::Vector2d(2.0 + 3.0 * std::cos(angle), 0.1 * std::sin(angle)));
    const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), one(0, 0, 1);
    const std::array<std::array<Eigen::Vector3d, 2>, 6> pairs{
        {{one, one}, {x, one}, {y, one}, {x, x}, {x, y}, {y, y}}};
    const PolygonRule rule = affine_rule(polygon);
    for (const auto& [f, g] : pairs) {
      const auto value = [](const Eigen::Vector3d& function, const Eigen::Vector2d& at) {
        return function.dot(Eigen::Vector3d(at.x(), at.y(), 1.0));
      };
      double exact = 0.0;
      for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const std::array<Eigen::Vector2d, 3> corners{polygon[0], polygon[k], polygon[k + 1]};
        const Eigen::Vector2d u = corners[1] - corners[0], v = corners[2] - corners[0];
        double products_sum = 0.0, sum_f = 0.0, sum_g = 0.0;
        for (const Eigen::Vector2d& corner : corners) {
          products_sum += value(f, corner) * value(g, corner);
          sum_f += value(f, corner);
          sum_g += value(g, corner);
        }
        exact += 0.5 * (u.x() * v.y() - u.y() * v.x()) / 12.0 * (products_sum + sum_f * sum_g);
      }
      double sum = 0.0;
      for (std::size_t k = 0; k < rule.points.size(); ++k)
        sum += rule.weights[k] * value(f, rule.points[k]) * value(g, rule.points[k]);
      EXPECT_NEAR(sum, exact, 1e-12) << trial;
    }
    for (const double weight : rule.weights) EXPECT_GT(weight, 0.0) << trial;
    for (const Eigen::Vector2d& point : rule.points) {
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Eigen::Vector2d side = polygon[(k + 1) % polygon.size()] - polygon[k];
        const Eigen::Vector2d there = point - polygon[k];
        EXPECT_GE(side.x() * there.y() - side.y() * there.x(), -1e-13) << trial;
      }
    }
  }
}

// A parallelogram: corners of 1/24 of the area each have half of its second moment, 1/3 of that of its corners, and the
// other half is that of 5/6 of the area at the distance of sqrt(1/5) of the corners. A triangle, 1/4: 1/8, 1/8 and 7/8.
TEST(Quadrature, AffineRuleHasTheCornersAndARingWithinThem) {
  const PolygonRule square = affine_rule({{0, 0}, {2, 0}, {3, 1}, {1, 1}});
  const Eigen::Vector2d middle(1.5, 0.5);
  ASSERT_EQ(square.points.size(), 8U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(square.weights[k], 2.0 / 24.0, 1e-15);
    EXPECT_NEAR(square.weights[k + 4], 2.0 * 5.0 / 24.0, 1e-15);
    EXPECT_NEAR((square.points[k + 4] - middle - std::sqrt(0.2) * (square.points[k] - middle)).norm(), 0.0,
                1e-15);
  }
  EXPECT_EQ(square.points[2], Eigen::Vector2d(3, 1));
  const PolygonRule triangle = affine_rule({{0, 0}, {3, 0}, {0, 2}});
  ASSERT_EQ(triangle.points.size(), 6U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(triangle.weights[k], 3.0 / 24.0, 1e-15);
    EXPECT_NEAR(triangle.weights[k + 3], 3.0 * 7.0 / 24.0, 1e-15);
  }
  EXPECT_EQ(affine_rule({{0, 0}, {2, 0}, {2, 0.5}, {1, 1}, {0, 1}}).points.size(), 12U);
  EXPECT_TRUE(affine_rule({{0, 0}, {1, 0}, {2, 0}}).points.empty());
}

// The unit square with two corners that hardly stick out: exact as before, triangle by triangle.
TEST(Quadrature, NearlyStraightCornersKeepARuleExact) {
  const double h = 0x1p-12;
  const std::vector<Eigen::Vector2d> polygon = {{0, 0}, {0.75, -h}, {1, 0}, {1, 1}, {0.25, 1 + h}, {0, 1}};
  const PolygonRule rule = polygon_rule(polygon, 3);
  const auto area = [](const Eigen::Vector2d&) { return 1.0; };
  // Below y = 0: the integral of y over a triangle of height h on a base of 1 is -h^2 / 6, of x it is its
  // area h / 2 times (0 + 0.75 + 1) / 3.
  EXPECT_NEAR(integrate(rule, area), 1.0 + h, 1e-15);
  EXPECT_NEAR(integrate(rule, [](const Eigen::Vector2d& p) { return p.x(); }),
              0.5 + h / 2 * 1.75 / 3 + h / 2 * 1.25 / 3, 1e-15);
  EXPECT_NEAR(integrate(rule, [](const Eigen::Vector2d& p) { return p.y(); }),
              0.5 - h * h / 6 + (h / 2 + h * h / 6), 1e-15);
  for (const double weight : rule.weights) EXPECT_GT(weight, 0.0);
}

// Where two sides that almost lie on each other cross is known badly: a rule is not exact for pressures with
// a kink, but its error may not jump with that place.
TEST(Quadrature, APolygonSeenFromBehindHasTheSamePoints) {
  // The second corner is nearly straight: its height over the line between its neighbours is 1.5e-4 of that line.
  const std::vector<Eigen::Vector2d> polygon = {{0, 0}, {1.2, -3e-4}, {2, 0}, {2, 1}, {0, 1.5}};
  std::vector<Eigen::Vector2d> behind;
  for (const Eigen::Vector2d& corner : polygon) behind.insert(behind.begin(), {-corner.x(), corner.y()});
  for (const int degree : {1, 2, 3, 6}) {
    const PolygonRule rule = polygon_rule(polygon, degree);
    const PolygonRule other = polygon_rule(behind, degree);
    ASSERT_EQ(rule.points.size(), other.points.size());
    for (std::size_t k = 0; k < rule.points.size(); ++k) {
      const Eigen::Vector2d there(-rule.points[k].x(), rule.points[k].y());
      const auto same = [&](std::size_t n) {
        return (other.points[n] - there).norm() < 1e-14 &&
               std::abs(other.weights[n] - rule.weights[k]) < 1e-15;
      };
      bool found = false;
      for (std::size_t n = 0; n < other.points.size(); ++n) found = found || same(n);
      EXPECT_TRUE(found) << degree << ": " << rule.points[k].transpose();
    }
  }
}

TEST(Quadrature, WhereSidesAlmostOnEachOtherCrossDoesNotMatter) {
  const auto kinked = [](const Eigen::Vector2d& p) { return std::max(0.0, p.x() + 0.3 * p.y() - 0.55); };
  const double square = integrate(polygon_rule({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 2), kinked);
  for (const double h : {1e-7, 1e-5}) {
    for (const double place : {0.01, 0.2, 0.5, 0.77, 0.999}) {
      const PolygonRule rule = polygon_rule({{0, 0}, {place, -h}, {1, 0}, {1, 1}, {0, 1}}, 2);
      // The triangle that sticks out has the area h / 2, and pressures are below 1.
      EXPECT_NEAR(integrate(rule, kinked), square, 0.5 * h) << h << ' ' << place;
    }
  }
}

TEST(Quadrature, WhatRoundingMakesOfALineStaysThere) {
  // Corners of three to five sides along the diagonal of a face, on either side of it by rounding: parts of
  // either sign whose centroid would be anywhere.
  std::mt19937_64 random(20261122);
  const auto any = [&] { return 0x1p-53 * static_cast<double>(random() >> 11U); };
  const Eigen::Vector2d diagonal(1.7, 1.1);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Eigen::Vector2d> sliver;
    for (int k = 0; k < 3 + trial % 3; ++k)
      sliver.push_back(any() * diagonal + 4e-16 * Eigen::Vector2d(any() - 0.5, any() - 0.5));
    const PolygonRule rule = polygon_rule(sliver, 4);
    double area = 0.0;
    for (std::size_t k = 0; k < rule.points.size(); ++k) {
      ASSERT_GT(rule.weights[k], 0.0) << trial;
      ASSERT_LE((rule.points[k] - 0.5 * diagonal).norm(), 0.51 * diagonal.norm()) << trial;
      area += rule.weights[k];
    }
    ASSERT_LE(area, 1e-14) << trial;
  }
  // Corners that are one to rounding: still the unit square, weights positive.
  const PolygonRule rule =
      polygon_rule({{0, 0}, {1e-17, -1e-17}, {1, 0}, {1, 1e-16}, {1, 1}, {1 - 1e-16, 1}, {0, 1}}, 4);
  EXPECT_NEAR(integrate(rule, [](const Eigen::Vector2d& p) { return p.x() * p.y(); }), 0.25, 1e-14);
  for (const double weight : rule.weights) EXPECT_GT(weight, 0.0);
}

TEST(Quadrature, TriangleRuleIsExact) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  for (int degree = 0; degree <= 12; ++degree) {
    const TriangleRule rule = triangle_rule(degree);
    for (int a = 0; a <= degree; ++a) {
      for (int b = 0; a + b <= degree; ++b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < rule.weights.size(); ++k) {
          sum += rule.weights[k] * std::pow(rule.barycentric[k][0], a) * std::pow(rule.barycentric[k][1], b);
        }
        EXPECT_NEAR(sum, 2.0 * factorial(a) * factorial(b) / factorial(a + b + 2), 1e-14);
      }
    }
  }
}

TEST(Quadrature, VolumeRuleGivesTheExactMoments) {
  for (const auto& [name, solid] : test_support::sample_solids()) {
    if (name == "far box") continue;  // whose moments are large differences
    for (const int degree : {0, 1, 4, 9}) {
      const VolumeRule rule = volume_rule(solid.mesh(), solid.mesh().points[1], degree);
      const auto exact = moments(solid.mesh(), degree);
      const auto exponents = monomial_exponents(degree);
      for (std::size_t k = 0; k < exact.size(); ++k) {
        double sum = 0.0;
        double size = 0.0;
        for (std::size_t n = 0; n < rule.points.size(); ++n) {
          double value = rule.weights[n];
          for (int axis = 0; axis < 3; ++axis)
            value *= std::pow(rule.points[n][axis], exponents[k][static_cast<std::size_t>(axis)]);
          sum += value;
          size += std::abs(value);
        }
        EXPECT_NEAR(sum, exact[k], 1e-13 * size) << name << degree;
      }
    }
  }
}

}  // namespace
}  // namespace ashlar::quadrature_test

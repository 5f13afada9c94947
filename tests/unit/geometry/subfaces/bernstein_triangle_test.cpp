#include "geometry/subfaces/bernstein_triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace ashlar::bernstein_triangle_test {
namespace {

constexpr std::array<bool, 3> no_rim = {false, false, false};
constexpr std::array<bool, 3> all_rim = {true, true, true};

Eigen::Matrix3Xd values_of(const BernsteinForm& form, const auto& field) {
  Eigen::Matrix3Xd values(3, form.size());
  const auto points = form.domain_points();
  for (std::size_t k = 0; k < points.size(); ++k) values.col(static_cast<Eigen::Index>(k)) = field(points[k]);
  return values;
}

Vector3 random_barycentric(std::mt19937_64& random) {
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  double a = unit(), b = unit();
  if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
  return {1.0 - a - b, a, b};
}

TEST(BernsteinTriangle, ControlPointsOfAKnownQuadratic) {
  // x = (l1, l2, l1 l2): l1 l2 is half the Bernstein polynomial of (0, 1, 1).
  const BernsteinForm& form = BernsteinForm::of_order(2);
  const BernsteinTriangle patch(
      form, values_of(form, [](const Vector3& l) { return Vector3(l[1], l[2], l[1] * l[2]); }));
  for (int k = 0; k < form.size(); ++k) {
    const auto& [i, j, m] = form.indices()[static_cast<std::size_t>(k)];
    const Vector3 expected(0.5 * j, 0.5 * m, i == 0 && j == 1 ? 0.5 : 0.0);
    EXPECT_LT((patch.control().col(k) - expected).norm(), 1e-15) << i << j << m;
  }
  // Largest at the middle of the side opposite corner 0: 1/4; the control point there says 1/2.
  EXPECT_NEAR(patch.chord_bound(no_rim), 0.5, 1e-13);
  EXPECT_DOUBLE_EQ(sampled_chord_error(patch, no_rim, 10), 0.25);
}

TEST(BernsteinTriangle, ReproducesPolynomialsOfEveryOrder) {
  std::mt19937_64 random(7);
  for (int order = 1; order <= BernsteinForm::max_order; ++order) {
    const BernsteinForm& form = BernsteinForm::of_order(order);
    const auto field = [&](const Vector3& l) {
      return Vector3(std::pow(l[1] - 0.3, order) + 1.0, std::pow(l[2] + l[1], order), l[0]);
    };
    const BernsteinTriangle patch(form, values_of(form, field));
    for (int trial = 0; trial < 50; ++trial) {
      const Vector3 l = random_barycentric(random);
      EXPECT_LT((patch.at(l) - field(l)).norm(), 1e-14 + 4.0 * patch.rounding()) << order;
    }
    EXPECT_LT(patch.rounding(), order <= 6 ? 1e-11 : 1e-8);
  }
}

TEST(BernsteinTriangle, HalvesAreTheSamePolynomial) {
  std::mt19937_64 random(11);
  const BernsteinForm& form = BernsteinForm::of_order(5);
  const BernsteinTriangle patch(form, values_of(form, [](const Vector3& l) {
                                  return Vector3(std::pow(l[0], 5), l[1] * l[2] * l[0], l[2] - l[1] * l[1]);
                                }));
  for (int side = 0; side < 3; ++side) {
    const auto halves = patch.halves(side);
    std::array<Vector3, 3> corners = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    const auto corner = [&](int k) { return corners[static_cast<std::size_t>((side + k) % 3)]; };
    const Vector3 middle = 0.5 * (corner(0) + corner(1));
    for (int trial = 0; trial < 20; ++trial) {
      const Vector3 l = random_barycentric(random);
      const Vector3 in_first = l[0] * middle + l[1] * corner(1) + l[2] * corner(2);
      const Vector3 in_second = l[0] * corner(0) + l[1] * middle + l[2] * corner(2);
      EXPECT_LT((halves[0].at(l) - patch.at(in_first)).norm(), 1e-14);
      EXPECT_LT((halves[1].at(l) - patch.at(in_second)).norm(), 1e-14);
    }
  }
}

TEST(BernsteinTriangle, BoundsHoldForRandomPatches) {
  std::mt19937_64 random(13);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
  for (int order = 2; order <= 8; ++order) {
    const BernsteinForm& form = BernsteinForm::of_order(order);
    for (int trial = 0; trial < 20; ++trial) {
      Eigen::Matrix3Xd values(3, form.size());
      for (Eigen::Index k = 0; k < values.size(); ++k) values.data()[k] = number();
      const BernsteinTriangle patch(form, values);
      EXPECT_GE(patch.chord_bound(all_rim), sampled_chord_error(patch, all_rim, 30));
      EXPECT_GE(patch.chord_bound(all_rim), patch.chord_bound(no_rim));
      const Box box = patch.box();
      const Eigen::Matrix3d axes =
          Eigen::AngleAxisd(3.0 * number(), Vector3(number(), number(), 1.1).normalized()).toRotationMatrix();
      const Box box_along_axes = patch.box(axes);
      for (int k = 0; k < 50; ++k) {
        const Vector3 x = patch.at(random_barycentric(random));
        EXPECT_TRUE(box.meets({x, x}));
        const Vector3 along = axes.transpose() * x;
        EXPECT_TRUE(box_along_axes.meets({along, along}));
      }
    }
  }
}

TEST(BernsteinTriangle, BoundOfASmallPatchIsWithinThreeTimesTheError) {
  // A piece of a wavy sheet z = sin(3 x) cos(2 y) / 10 taken at the domain points, ever smaller.
  for (int order = 2; order <= 8; ++order) {
    const BernsteinForm& form = BernsteinForm::of_order(order);
    for (const double size : {0.2, 0.1, 0.05}) {
      const BernsteinTriangle patch(form, values_of(form, [&](const Vector3& l) {
                                      const double x = 0.2 + size * l[1], y = 0.1 + size * l[2];
                                      return Vector3(x, y, 0.1 * std::sin(3 * x) * std::cos(2 * y));
                                    }));
      const double error = sampled_chord_error(patch, all_rim, 40);
      EXPECT_GE(patch.chord_bound(all_rim), error);
      EXPECT_LE(patch.chord_bound(all_rim), 3.0 * error) << order << " " << size;
    }
  }
}

TEST(BernsteinTriangle, APatchWithoutAreaCountsAsAPoint) {
  const BernsteinForm& form = BernsteinForm::of_order(2);
  const BernsteinTriangle patch(form,
                                values_of(form, [](const Vector3& l) { return Vector3(l[1] + l[2], 0, 0); }));
  EXPECT_NEAR(patch.chord_bound(no_rim), 1.0, 1e-13);
}

TEST(BernsteinTriangle, MotionIsBoundedByControlPoints) {
  const BernsteinForm& form = BernsteinForm::of_order(3);
  const auto still = values_of(form, [](const Vector3& l) { return Vector3(l[1], l[2], 0); });
  const auto moved = values_of(form, [](const Vector3& l) { return Vector3(l[1] + 3.0, l[2] - 4.0, 0); });
  const BernsteinTriangle a(form, still);
  EXPECT_NEAR(BernsteinTriangle(form, moved).distance_bound(a), 5.0, 1e-12);
  EXPECT_LT(a.distance_bound(a), 1e-12);
}

TEST(BernsteinForm, RefusesOtherOrders) {
  EXPECT_THROW((void)BernsteinForm::of_order(0), std::invalid_argument);
  EXPECT_THROW((void)BernsteinForm::of_order(13), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::bernstein_triangle_test

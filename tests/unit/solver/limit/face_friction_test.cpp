#include "solver/limit/face_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ashlar::face_friction_test {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

// a/6 (sqrt(2) + asinh(1)) of a square of side a; of a disc 2/3 of its radius.
TEST(FaceFriction, MeanDistanceOfASquareAndADisc) {
  const double square = 2.0 / 6.0 * (std::sqrt(2.0) + std::asinh(1.0));
  EXPECT_NEAR(mean_distance({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, {0, 0}), square, 1e-15);
  // In three parts, one of them far from the centre, in another view and from behind.
  const Polygon left{{4, 4}, {5, 4}, {5, 6}, {4, 6}}, low{{5, 4}, {6, 4}, {6, 4.5}, {5, 4.5}},
      high{{5, 4.5}, {6, 4.5}, {6, 6}, {5, 6}};
  EXPECT_NEAR(mean_distance({left, low, high}, {5, 5}), square, 1e-14);
  EXPECT_NEAR(mean_distance({{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}}, {0, 0}), square, 1e-15);
  Polygon disc;
  for (int k = 0; k < 2000; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 2000.0;
    disc.emplace_back(3.0 * std::cos(angle), 3.0 * std::sin(angle));
  }
  EXPECT_NEAR(mean_distance({disc}, {0, 0}), 2.0, 1e-5);
}

// From a corner of a rectangle a x b: (d/3 + a^2/(6 b) asinh(b/a) + b^2/(6 a) asinh(a/b)), d the diagonal.
TEST(FaceFriction, MeanDistanceFromACorner) {
  const double a = 3.0, b = 4.0;
  const double exact =
      5.0 / 3.0 + a * a / (6.0 * b) * std::asinh(b / a) + b * b / (6.0 * a) * std::asinh(a / b);
  EXPECT_NEAR(mean_distance({{{0, 0}, {a, 0}, {a, b}, {0, b}}}, {0, 0}), exact, 1e-14);
}

}  // namespace
}  // namespace ashlar::face_friction_test

#include "geometry/exact/piercing_point.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/exact/direction_constructions.hpp"
#include "geometry/exact/direction_predicates.hpp"

namespace ashlar::piercing_point_test {
namespace {

NumberVector<DoubleDouble> exact_vector(double x, double y, double z) {
  return {DoubleDouble(x), DoubleDouble(y), DoubleDouble(z)};
}

TEST(PiercingPoint, AThirdOfTheWayUp) {
  const auto point = quick_piercing_point(exact_vector(0, 0, 5), {0, 0, 0}, {1, 6, 3}, {7, 8, 1});
  ASSERT_TRUE(point.has_value());
  EXPECT_EQ(*point, Vector3(1.0 / 3.0, 2.0, 1.0));
}

TEST(PiercingPoint, LeavesAnExactZeroToOthers) {
  EXPECT_FALSE(quick_piercing_point(exact_vector(0, 0, 1), {-1, 1, 1}, {1, 2, 3}, {0, 0, 2}).has_value());
}

// Half way between two doubles: no number of correct bits decides how to round.
TEST(PiercingPoint, LeavesATieToOthers) {
  const Vector3 a(1.0, 0.0, -1.0), b(1.0 + 0x1p-52, 1.0, 1.0);
  EXPECT_FALSE(quick_piercing_point(exact_vector(0, 0, 1), a, b, {0, 0, 0}).has_value());
}

// Against the rational rung of plane_point.
TEST(PiercingPoint, RoundsAsRationalArithmeticDoes) {
  std::mt19937_64 random(11);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-52 - 1.0; };
  const auto point = [&] {
    const double x = uniform(), y = uniform();
    return Vector3(x, y, uniform());
  };
  int decided = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector3 p = point(), q = point(), r = point(), a = point();
    const ContactDirection w = ContactDirection::cross({&q, &p}, {&r, &p});
    PredicateLadder exact{false, {}};
    // Every other segment ends close to the plane.
    const Vector3 b = k % 2 == 0 ? point() : Vector3((p + q + r) / 3.0);
    if (sign_along(w, a, p, exact) * sign_along(w, b, p, exact) >= 0) continue;
    const auto quick = quick_piercing_point(w.double_double(), a, b, p);
    if (!quick) continue;
    ++decided;
    EXPECT_EQ(*quick, plane_point(w, a, b, p, exact)) << k;
  }
  EXPECT_GT(decided, 500);
}

}  // namespace
}  // namespace ashlar::piercing_point_test

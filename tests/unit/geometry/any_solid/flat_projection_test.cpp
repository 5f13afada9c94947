#include "geometry/any_solid/flat_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/exact_numbers.hpp"

namespace ashlar::flat_projection_test {
namespace {

TEST(FlatProjection, BoundsOfACoordinateEncloseItsExactValueClosely) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  for (const Rational& exact : {Rational(1, 3), Rational(-1, 3), Rational(2, 7), Rational(-1000001, 999),
                                Rational(Rational(tiny) / 3)}) {
    const Coordinate c = coordinate(exact, false);
    const double least = least_value(c.tracked), greatest = greatest_value(c.tracked);
    EXPECT_LT(Rational(least), exact);
    EXPECT_GT(Rational(greatest), exact);
    // To either side 4 units of rounding, twice, the rounding of their sum, and the next number, at most 2 units away.
    EXPECT_LE(greatest - least, 22.0 * 0x1p-53 * std::abs(exact.get_d()) + 8.0 * tiny);
  }
}

TEST(FlatProjection, ANumberWithoutErrorIsItsOwnBound) {
  for (const double value : {0.0, 0.1, -3e300}) {
    const Coordinate c = coordinate(Rational(value), true);
    EXPECT_EQ(least_value(c.tracked), value);
    EXPECT_EQ(greatest_value(c.tracked), value);
  }
}

}  // namespace
}  // namespace ashlar::flat_projection_test

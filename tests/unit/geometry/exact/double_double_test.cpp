#include "geometry/exact/double_double.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ashlar::double_double_test {
namespace {

TEST(TrackedNumber, DoubtIsAdmitted) {
  const TrackedNumber third(1.0 / 3.0, 0x1p-54);
  EXPECT_EQ(sign_of(third), 1);
  EXPECT_EQ(sign_of(third - third), unknown_sign);
  EXPECT_EQ(sign_of(TrackedNumber(0.0) * third), 0);
  EXPECT_EQ(sign_of(TrackedNumber::difference(0.5, 0.5) * third), 0);
}

TEST(DoubleDouble, ShortNumbersStayExact) {
  const DoubleDouble a = DoubleDouble::difference(1.0, 0x1p-60);  // needs 60 bits
  EXPECT_EQ(a.error, 0.0);
  const DoubleDouble zero = a + DoubleDouble(0x1p-60) - DoubleDouble(1.0);
  EXPECT_EQ(sign_of(zero), 0);
  const DoubleDouble product = DoubleDouble(0x1p40 + 1.0) * DoubleDouble(0x1p40 - 1.0);
  EXPECT_EQ(sign_of(product - DoubleDouble(0x1p80) + DoubleDouble(1.0)), 0);
}

TEST(DoubleDouble, SignsBeyondDoublePrecision) {
  const DoubleDouble a = DoubleDouble(1.0) + DoubleDouble(0x1p-100);
  EXPECT_EQ(sign_of(a - DoubleDouble(1.0)), 1);
  EXPECT_EQ(sign_of(DoubleDouble(1.0) - a), -1);
}

TEST(DoubleDouble, QuotientsRoundLikeTheDivisionOfDoubles) {
  for (const double n : {1.0, 3.0, -7.0, 0x1p52 + 1.0})
    for (const double d : {3.0, 7.0, -11.0, 0x1p30 + 1.0}) {
      const auto q = quotient(DoubleDouble(n), DoubleDouble(d));
      ASSERT_TRUE(q.has_value());
      EXPECT_EQ(rounded(*q), n / d);
    }
  EXPECT_FALSE(quotient(DoubleDouble(1.0), DoubleDouble(0.0)).has_value());
  EXPECT_FALSE(quotient(DoubleDouble(1.0), DoubleDouble(0x1p-40, 0.0, 0x1p-40)).has_value());
  // 1 / (1 + 2^-1070) is just below 1: the rounded part of the product with the low part must not count as zero.
  EXPECT_FALSE(quotient(DoubleDouble(1.0 + 0x1p-30), DoubleDouble(1.0, 0x1p-1070, 0.0)).has_value());
}

TEST(DoubleDouble, SquareRootsRoundLikeThoseOfDoubles) {
  for (const double a : {1.0, 2.0, 3.0, 0x1p-30, 1.0 + 0x1p-40}) {
    const auto root = square_root(DoubleDouble(a));
    ASSERT_TRUE(root.has_value());
    EXPECT_EQ(rounded(*root), std::sqrt(a));
  }
}

TEST(DoubleDouble, RoundingIsRefusedNearTheMiddleOfTwoDoubles) {
  const double half_ulp = 0x1p-53;
  EXPECT_EQ(rounded(DoubleDouble(1.0, half_ulp, 0.0)), 1.0);  // exact tie: to even
  EXPECT_FALSE(rounded(DoubleDouble(1.0, half_ulp, 0x1p-110)).has_value());
  EXPECT_EQ(rounded(DoubleDouble(1.0, 0.5 * half_ulp, 0x1p-110)), 1.0);
}

}  // namespace
}  // namespace ashlar::double_double_test

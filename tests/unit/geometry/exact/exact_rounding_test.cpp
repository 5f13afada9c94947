#include "geometry/exact/exact_rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/exact_numbers.hpp"

namespace ashlar::exact_rounding_test {
namespace {

struct Rational {
  mpq_t q;
  explicit Rational(const std::string& text) {
    mpq_init(q);
    mpq_set_str(q, text.c_str(), 10);
    mpq_canonicalize(q);
  }
  explicit Rational(double exact) {
    mpq_init(q);
    mpq_set_d(q, exact);
  }
  ~Rational() { mpq_clear(q); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
};

TEST(ExactRounding, DoublesComeBackUnchanged) {
  for (const double x : {0.0, 1.0, -3.5, 0.1, 0x1p-1074, -0x1.8p-1070, 0x1.fffffffffffffp1023, 0x1p-1022})
    EXPECT_EQ(round_to_nearest(Rational(x).q), x);
}

TEST(ExactRounding, FractionsGoToTheNearestDouble) {
  EXPECT_EQ(round_to_nearest(Rational("1/3").q), 1.0 / 3.0);  // one division rounds once
  EXPECT_EQ(round_to_nearest(Rational("-2/3").q), -2.0 / 3.0);
  EXPECT_EQ(round_to_nearest(Rational("1/10").q), 0.1);
}

TEST(ExactRounding, TiesGoToEven) {
  // 2^53 + 1 is half way between 2^53 and 2^53 + 2, 2^53 + 3 between 2^53 + 2 and 2^53 + 4.
  EXPECT_EQ(round_to_nearest(Rational("9007199254740993").q), 0x1p53);
  EXPECT_EQ(round_to_nearest(Rational("9007199254740995").q), 0x1p53 + 4.0);
  // A hair more than half way.
  EXPECT_EQ(round_to_nearest(Rational("90071992547409930000000000000000001/10000000000000000000").q),
            std::nextafter(9007199254740993.0, INFINITY));
}

TEST(ExactRounding, SubnormalResultsAreRoundedOnce) {
  Rational q("1/3");
  mpq_div_2exp(q.q, q.q, 1072);  // 4/3 2^-1074
  EXPECT_EQ(round_to_nearest(q.q), 0x1p-1074);
  mpq_div_2exp(q.q, q.q, 1);  // 2/3 2^-1074
  EXPECT_EQ(round_to_nearest(q.q), 0x1p-1074);
  mpq_div_2exp(q.q, q.q, 1);  // 1/3 2^-1074
  EXPECT_EQ(round_to_nearest(q.q), 0.0);
}

TEST(ExactRounding, SquareRoots) {
  EXPECT_EQ(round_square_root(Rational("0").q), 0.0);
  EXPECT_EQ(round_square_root(Rational("4/9").q), 2.0 / 3.0);
  EXPECT_EQ(round_square_root(Rational("2").q), std::sqrt(2.0));  // IEEE: correctly rounded
  EXPECT_EQ(round_square_root(Rational(0x1p-1074).q), 0x1p-537);
  EXPECT_EQ(round_square_root(Rational("81129638414606681695789005144064").q), 0x1p53);
}

}  // namespace
}  // namespace ashlar::exact_rounding_test

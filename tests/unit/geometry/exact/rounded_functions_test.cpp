#include "geometry/exact/rounded_functions.hpp"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cfenv>
#include <cmath>
#include <limits>
#include <random>

namespace ashlar::correctly_rounded::rounded_functions_test {
namespace {

namespace multi = boost::multiprecision;
using Many = multi::number<multi::mpfr_float_backend<60>>;
using Limits = std::numeric_limits<double>;

/// True if no other double is nearer to a value of 60 digits.
bool is_nearest(double result, const Many& value) {
  const Many error = multi::abs(value - result);
  return error <= multi::abs(value - std::nextafter(result, Limits::infinity())) &&
         error <= multi::abs(value - std::nextafter(result, -Limits::infinity()));
}

TEST(RoundedFunctions, NoOtherDoubleIsNearer) {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> share(-1.0, 1.0), decade(-12.0, 3.0);
  for (int n = 0; n < 3000; ++n) {
    const double x = std::copysign(std::pow(10.0, decade(random)), share(random)), y = 40.0 * share(random);
    const double unit = share(random);
    ASSERT_TRUE(is_nearest(sin(x), multi::sin(Many(x)))) << x;
    ASSERT_TRUE(is_nearest(cos(x), multi::cos(Many(x)))) << x;
    ASSERT_TRUE(is_nearest(tan(x), multi::tan(Many(x)))) << x;
    ASSERT_TRUE(is_nearest(atan(x), multi::atan(Many(x)))) << x;
    ASSERT_TRUE(is_nearest(atan2(x, y), multi::atan2(Many(x), Many(y)))) << x << ", " << y;
    ASSERT_TRUE(is_nearest(asin(unit), multi::asin(Many(unit)))) << unit;
    ASSERT_TRUE(is_nearest(acos(unit), multi::acos(Many(unit)))) << unit;
    ASSERT_TRUE(is_nearest(sinh(y), multi::sinh(Many(y)))) << y;
    ASSERT_TRUE(is_nearest(cosh(y), multi::cosh(Many(y)))) << y;
    ASSERT_TRUE(is_nearest(tanh(unit), multi::tanh(Many(unit)))) << unit;
    ASSERT_TRUE(is_nearest(exp(y), multi::exp(Many(y)))) << y;
    ASSERT_TRUE(is_nearest(log(std::abs(x)), multi::log(Many(std::abs(x))))) << x;
    ASSERT_TRUE(is_nearest(cbrt(x), multi::cbrt(Many(x)))) << x;
    ASSERT_TRUE(is_nearest(pow(std::abs(x), unit), multi::pow(Many(std::abs(x)), Many(unit))))
        << x << ", " << unit;
    ASSERT_TRUE(is_nearest(hypot(x, y), multi::sqrt(Many(x) * x + Many(y) * y))) << x << ", " << y;
    const Many half_circle = boost::math::constants::pi<Many>();
    ASSERT_TRUE(is_nearest(sin_of_degrees(y), multi::sin(Many(y) * half_circle / 180))) << y;
    ASSERT_TRUE(is_nearest(cos_of_degrees(y), multi::cos(Many(y) * half_circle / 180))) << y;
    ASSERT_TRUE(is_nearest(tan_of_degrees(y), multi::tan(Many(y) * half_circle / 180))) << y;
    ASSERT_TRUE(is_nearest(degrees_of_atan2(x, y), multi::atan2(Many(x), Many(y)) * 180 / half_circle))
        << x << ", " << y;
    ASSERT_TRUE(is_nearest(asinh(x), multi::asinh(Many(x)))) << x;
    ASSERT_TRUE(is_nearest(log10(std::abs(x)), multi::log10(Many(std::abs(x))))) << x;
    ASSERT_TRUE(is_nearest(log1p(unit), multi::log1p(Many(unit)))) << unit;
    ASSERT_TRUE(is_nearest(degrees_of_atan(y), multi::atan(Many(y)) * 180 / half_circle)) << y;
  }
}

TEST(RoundedFunctions, DegreesAreExactWhereTheValueIs) {
  EXPECT_EQ(tan_of_degrees(45.0), 1.0);
  EXPECT_EQ(tan_of_degrees(-405.0), -1.0);
  EXPECT_EQ(sin_of_degrees(30.0), 0.5);
  EXPECT_EQ(cos_of_degrees(60.0 + 360.0e6), 0.5);
  EXPECT_EQ(cos_of_degrees(90.0), 0.0);
  EXPECT_EQ(sin_of_degrees(-180.0), 0.0);
  EXPECT_EQ(degrees_of_atan(1.0), 45.0);
  EXPECT_EQ(degrees_of_atan2(1e-300, -1e-300), 135.0);
}

TEST(RoundedFunctions, EndsOfTheRange) {
  EXPECT_EQ(exp(710.0), Limits::infinity());
  EXPECT_EQ(exp(-1000.0), 0.0);
  EXPECT_EQ(pow(2.0, -1074.0), Limits::denorm_min());
  // sqrt(2) of the least double is nearer to 1 of it than to 2.
  EXPECT_EQ(hypot(Limits::denorm_min(), Limits::denorm_min()), Limits::denorm_min());
  EXPECT_EQ(cbrt(-0x1p-1074), -0x1p-358);
  EXPECT_EQ(hypot(3e300, 4e300), 5e300);
  EXPECT_TRUE(std::isnan(log(-1.0)));
  EXPECT_TRUE(std::isnan(acos(1.0 + Limits::epsilon())));
  EXPECT_TRUE(std::isnan(sin(Limits::infinity())));
  EXPECT_EQ(log(0.0), -Limits::infinity());
}

TEST(RoundedFunctions, FaultsAreRaised) {
  const auto raised = [](double value) {
    const int faults = std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    std::feclearexcept(FE_ALL_EXCEPT);
    return std::pair(value, faults);
  };
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_EQ(raised(log(0.0)).second, FE_DIVBYZERO);
  EXPECT_EQ(raised(exp(1000.0)).second, FE_OVERFLOW);
  EXPECT_EQ(raised(asin(2.0)).second, FE_INVALID);
  EXPECT_EQ(raised(tan_of_degrees(90.0)).second, FE_DIVBYZERO);
  EXPECT_EQ(raised(cos(1.0)).second, 0);
}

}  // namespace
}  // namespace ashlar::correctly_rounded::rounded_functions_test

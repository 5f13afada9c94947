#include "apps/program/sweep/random_value.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ashlar::random_value_test {
namespace {

Distribution distribution(const char* text) {
  return parse_distribution(text).value();
}

TEST(RandomValue, DistributionsAreReadByName) {
  EXPECT_EQ(distribution("normal(32, 2)"), (Distribution{Distribution::Kind::normal, {32, 2}, {}}));
  EXPECT_EQ(distribution(" normal( 32,2 , 20, 45)").within, (std::array<double, 2>{20, 45}));
  EXPECT_EQ(distribution("triangular(1,2,4)").parameters, (std::vector<double>{1, 2, 4}));
  for (const char* other : {"3", "max(1,2)", "normal", "= normal", "normally(1,2)", "[1,2]"})
    EXPECT_FALSE(parse_distribution(other)) << other;
  for (const char* bad : {"normal()", "normal(1)", "normal(1,-2)", "normal(1,2,3)", "normal(1,2,5,4)",
                          "normal(a,1)", "normal(1e999,1)", "lognormal(0,1)", "uniform(2,1)", "uniform(1)",
                          "triangular(1,0,2)", "triangular(1,1,1)"})
    EXPECT_THROW((void)parse_distribution(bad), std::invalid_argument) << bad;
}

TEST(RandomValue, QuantilesAreThoseOfTables) {
  // Quantiles of the normal distribution: 1.959963984540054 deviations at 97.5 %, 3.090232306167814 at 99.9 %.
  EXPECT_NEAR(quantile(distribution("normal(10, 2)"), 0.975), 10 + 2 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(quantile(distribution("normal(0, 1)"), 0.001), -3.090232306167814, 1e-12);
  EXPECT_NEAR(quantile(distribution("normal(0, 1)"), 0.5), 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(quantile(distribution("uniform(20, 30)"), 0.25), 22.5);
  // For the triangle from 1 to 5 with its tip at 2, a quarter of its area lies below the tip.
  EXPECT_NEAR(quantile(distribution("triangular(1, 2, 5)"), 0.25), 2.0, 1e-12);
  EXPECT_NEAR(quantile(distribution("triangular(1, 2, 5)"), 1.0 - 1.0 / 12.0), 4.0, 1e-12);
  // The median of a lognormal value is mean / sqrt(1 + (deviation / mean)^2).
  EXPECT_NEAR(quantile(distribution("lognormal(1e5, 5e4)"), 0.5), 1e5 / std::sqrt(1.25), 1e-6);
}

TEST(RandomValue, MomentsAreThoseAskedFor) {
  // Means of quantiles in the middles of equal shares.
  for (const char* text : {"normal(30, 3)", "lognormal(30, 3)"}) {
    constexpr int count = 200'000;
    double mean = 0.0, square = 0.0;
    for (int k = 0; k < count; ++k) {
      const double value = quantile(distribution(text), (k + 0.5) / count);
      mean += value / count;
      square += value * value / count;
    }
    EXPECT_NEAR(mean, 30.0, 1e-3) << text;
    EXPECT_NEAR(std::sqrt(square - mean * mean), 3.0, 1e-3) << text;
  }
}

TEST(RandomValue, DrawsStayWithinBounds) {
  Draws draws(3), same(3);
  const Distribution bounded = distribution("normal(30, 5, 28, 31)");
  for (int k = 0; k < 200; ++k) {
    const double value = draws.draw(bounded);
    EXPECT_GE(value, 28.0);
    EXPECT_LE(value, 31.0);
    EXPECT_EQ(value, same.draw(bounded));
  }
  EXPECT_THROW((void)draws.draw(distribution("normal(30, 1, 100, 101)")), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::random_value_test

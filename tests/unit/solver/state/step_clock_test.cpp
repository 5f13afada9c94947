#include "solver/state/step_clock.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace ashlar::step_clock_test {
namespace {

TEST(DecimalSum, IsTheDecimalNumberNextToNothing) {
  EXPECT_EQ(decimal_sum(0.0, 3, 0.1), 0.3);
  EXPECT_NE(3 * 0.1, 0.3) << "what doubles alone make of it";
  EXPECT_EQ(decimal_sum(0.0, 15000, 2e-3), 30.0);
  EXPECT_EQ(decimal_sum(0.0, 9, 1e-3), 0.009);
  EXPECT_EQ(decimal_sum(0.0105, 1, 1e-3), 0.0115);
  EXPECT_EQ(decimal_sum(0.0, 7, 1e3), 7000.0);
  EXPECT_EQ(decimal_sum(0.0, 3, 1e-30), 3 * 1e-30);
  EXPECT_EQ(decimal_sum(0.5, 0, 0.1), 0.5);
  EXPECT_EQ(decimal_sum(0.5, -2, 0.1), 0.3);
  EXPECT_EQ(decimal_sum(-0.1, 1, 0.3), 0.2);
}

TEST(DecimalSum, IsTheTextOfEveryMultipleOfATextOfDigits) {
  for (const int digits : {1, 5, 25, 125, 3333}) {
    for (int count = 0; count < 20000; count += 7) {
      const std::string text = std::to_string(digits * count) + "e-6";
      ASSERT_EQ(decimal_sum(0.0, count, std::stod(std::to_string(digits) + "e-6")), std::stod(text)) << text;
    }
  }
}

TEST(DecimalSum, IsProductAndSumWhereDigitsAreTooMany) {
  const double third = 1.0 / 3.0;
  EXPECT_EQ(decimal_sum(0.0, 1000003, third), 1000003 * third);
  EXPECT_EQ(decimal_sum(third, 3, 0.1), third + 3 * 0.1);
  EXPECT_EQ(decimal_sum(1e300, 2, 1e-300), 1e300);
  EXPECT_EQ(decimal_sum(0.0, 4, 1e300), 4e300);
  EXPECT_EQ(decimal_sum(0.0, std::int64_t{1} << 60, 0.3), std::ldexp(0.3, 60));
  EXPECT_EQ(decimal_sum(0.0, 1, std::numeric_limits<double>::infinity()),
            std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(decimal_sum(0.0, 1, std::numeric_limits<double>::quiet_NaN())));
}

TEST(StepClock, CountsWholeStepsAndStartsAnewWithEveryOtherLength) {
  StepClock clock;
  for (int k = 1; k <= 100000; ++k) {
    EXPECT_EQ(clock.time_after(0.0), clock.time());
    const double next = clock.time_after(1e-4);
    clock.advance(1e-4);
    ASSERT_EQ(clock.time(), next);
    ASSERT_EQ(clock.time(), k / 1e4);
  }
  const double cut = 1e-4 / 3.0;
  clock.advance(cut);
  EXPECT_EQ(clock.count, 1);
  EXPECT_EQ(clock.time(), 10.0 + cut);
  for (int k = 0; k < 1000; ++k) clock.advance(1e-4);
  EXPECT_EQ(clock.time(), 10.0 + cut + 1000 * 1e-4) << "rounded once, whatever the start";
  clock.advance(0.0);
  EXPECT_EQ(clock.count, 1000);
}

}  // namespace
}  // namespace ashlar::step_clock_test

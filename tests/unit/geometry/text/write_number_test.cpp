#include "geometry/text/write_number.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

namespace ashlar::write_number_test {
namespace {

std::string written(double value, NumberForm form = NumberForm::shorter) {
  std::array<char, longest_number> text{};
  return {text.data(), write_number(text.data(), value, form)};
}

TEST(WriteNumber, TheShorterOfBothForms) {
  EXPECT_EQ(written(0.0), "0");
  EXPECT_EQ(written(-0.0), "-0");
  EXPECT_EQ(written(0.1), "0.1");
  EXPECT_EQ(written(-12.5), "-12.5");
  EXPECT_EQ(written(0.001), "0.001");
  EXPECT_EQ(written(1e-5), "1e-05");
  EXPECT_EQ(written(1.5e-7), "1.5e-07");
  EXPECT_EQ(written(100000.0), "1e+05");
  EXPECT_EQ(written(123456.0), "123456");
  EXPECT_EQ(written(1e22), "1e+22");
  EXPECT_EQ(written(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(written(std::numeric_limits<double>::denorm_min()), "5e-324");
  EXPECT_EQ(written(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
}

TEST(WriteNumber, ChosenForms) {
  EXPECT_EQ(written(100000.0, NumberForm::fixed), "100000");
  EXPECT_EQ(written(-999999999999999.0, NumberForm::fixed), "-999999999999999");
  EXPECT_EQ(written(0.0, NumberForm::scientific), "0e+00");
  EXPECT_EQ(written(0.25, NumberForm::scientific), "2.5e-01");
  EXPECT_EQ(written(3e100, NumberForm::scientific), "3e+100");
}

TEST(WriteNumber, NoNumbers) {
  EXPECT_EQ(written(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(written(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(written(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace ashlar::write_number_test

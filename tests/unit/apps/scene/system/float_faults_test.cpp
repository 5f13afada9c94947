#include "apps/scene/system/float_faults.hpp"

#include <gtest/gtest.h>

namespace ashlar::float_faults_test {
namespace {

TEST(FloatFaults, AreCountedUntilTheyAreForgotten) {
  volatile double zero = 0.0, large = 1e300;
  forget_float_faults();
  EXPECT_FALSE(float_faults(zero + large).any());
  volatile double result = 1.0 / (1.0 / zero);
  EXPECT_EQ(result, 0.0);
  EXPECT_TRUE(float_faults(result).division) << "although the result is finite";
  forget_float_faults();
  EXPECT_FALSE(float_faults(result).any());
  result = zero / zero;
  EXPECT_TRUE(float_faults(result).invalid);
  EXPECT_FALSE(float_faults(result).division);
  forget_float_faults();
  result = large * large;
  EXPECT_TRUE(float_faults(result).overflow);
  forget_float_faults();
}

}  // namespace
}  // namespace ashlar::float_faults_test

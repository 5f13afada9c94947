#include "apps/results/tables/response_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ashlar::response_spectrum_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(ResponseSpectrum, ConstantAccelerationMovesAnUndampedOscillatorToTwiceItsRest) {
  for (const double period : {0.01, 0.3, 2.0}) {
    const SpectrumPoint found = response_spectrum({{10.0, 3.0, 3.0}}, {period}, 0.0).front();
    const double w = 2.0 * pi / period;
    EXPECT_NEAR(found.displacement * w * w, 6.0, 6.0 * 3e-5) << period;
    EXPECT_NEAR(found.pseudo_acceleration, 6.0, 6.0 * 3e-5) << period;
    EXPECT_NEAR(found.pseudo_velocity, 6.0 / w, 6.0 / w * 3e-5) << period;
  }
}

TEST(ResponseSpectrum, DampedOvershootIsTheClosedForm) {
  // exp(-pi z / sqrt(1 - z^2)) beyond the rest of a step.
  for (const double z : {0.02, 0.05, 0.5}) {
    const SpectrumPoint found = response_spectrum({{10.0, 1.0, 1.0}}, {1.0}, z).front();
    const double expected = 1.0 + std::exp(-pi * z / std::sqrt(1.0 - z * z));
    EXPECT_NEAR(found.pseudo_acceleration, expected, 3e-5 * expected) << z;
  }
}

TEST(ResponseSpectrum, ShortImpulseGivesItsVelocityAfterTheRecord) {
  // 1e-4 s of 100 m/s^2: 0.01 m/s, so that an undamped oscillator swings by v / w after the end of the record.
  const SpectrumPoint found = response_spectrum({{1e-4, 100.0, 100.0}}, {1.0}, 0.0).front();
  EXPECT_NEAR(found.pseudo_velocity, 0.01, 0.01 * 3e-5);
}

TEST(ResponseSpectrum, LongSegmentsAreExact) {
  // A ramp as one segment and as many.
  const std::vector<double> periods = {0.05, 0.4, 3.0};
  std::vector<double> times, values;
  for (int k = 0; k <= 1000; ++k) {
    times.push_back(2e-3 * k);
    values.push_back(3.0 * times.back() - 1.0);
  }
  const auto one = response_spectrum({{2.0, -1.0, 5.0}}, periods, 0.05);
  const auto many = response_spectrum(segments_of_acceleration(times, values), periods, 0.05);
  for (std::size_t k = 0; k < periods.size(); ++k)
    EXPECT_NEAR(one[k].displacement, many[k].displacement, 3e-5 * one[k].displacement);
}

TEST(ResponseSpectrum, SegmentsOfVelocities) {
  const auto segments = segments_of_velocity({0.0, 0.5, 2.0}, {1.0, 2.0, 2.0});
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].start, 2.0);
  EXPECT_EQ(segments[0].end, 2.0);
  EXPECT_EQ(segments[1].length, 1.5);
  EXPECT_EQ(segments[1].start, 0.0);
}

TEST(ResponseSpectrum, PeriodsHaveEqualRatios) {
  const std::vector<double> periods = spectrum_periods(0.01, 10.0, 4);
  ASSERT_EQ(periods.size(), 4U);
  EXPECT_EQ(periods.front(), 0.01);
  EXPECT_NEAR(periods[1], 0.1, 1e-15);
  EXPECT_NEAR(periods[2], 1.0, 1e-14);
  EXPECT_EQ(periods.back(), 10.0);
}

}  // namespace
}  // namespace ashlar::response_spectrum_test

#include "mechanics/supports/recorded_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ashlar::recorded_motion_test {
namespace {

SupportHistory history_of(MotionRecord record, const std::vector<double>& times,
                          const std::vector<double>& x) {
  SupportHistory history{times, {}, record};
  for (const double value : x) history.values.emplace_back(value, 0, -2 * value);
  return history;
}

// Uneven rows of no order.
const std::vector<double> times = {0.5, 0.6, 1.1, 1.15, 2.0};
const std::vector<double> values = {3.0, -1.0, 0.5, 4.0, -2.0};

double on_lines(double t) {
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    if (t >= times[k] && t < times[k + 1])
      return values[k] + (t - times[k]) / (times[k + 1] - times[k]) * (values[k + 1] - values[k]);
  return 0.0;
}

TEST(RecordedMotion, AccelerationIsTheRecordAndItsIntegrals) {
  const RecordedMotion motion(history_of(MotionRecord::acceleration, times, values));
  // Sums over short lines of the record that has no row inside them: exact by Simpson's rule.
  double v = 0.0, u = 0.0;
  constexpr int parts = 300;
  for (int n = 0; n < parts; ++n) {
    const double t = 0.5 + 0.005 * n, next = t + 0.005, h = next - t;
    EXPECT_NEAR(motion.acceleration(t).x(), on_lines(t), 1e-12);
    const double start = on_lines(t + 1e-13), end = on_lines(next - 1e-13);
    u += h * v + h * h / 6.0 * (2.0 * start + end);
    v += 0.5 * h * (start + end);
    if (n + 1 == parts) break;
    EXPECT_NEAR(motion.velocity(next).x(), v, 1e-9) << next;
    EXPECT_NEAR(motion.displacement(next).x(), u, 1e-9) << next;
    EXPECT_NEAR(motion.displacement(next).z(), -2.0 * u, 1e-9) << next;
  }
  // At rest before; afterwards with the remaining velocity.
  EXPECT_EQ(motion.velocity(0.49), Vector3::Zero());
  EXPECT_EQ(motion.displacement(-7.0), Vector3::Zero());
  EXPECT_EQ(motion.acceleration(2.5), Vector3::Zero());
  EXPECT_NEAR(motion.velocity(9.0).x(), v, 1e-9);
  EXPECT_NEAR(motion.displacement(3.0).x(), u + v, 1e-8);
}

TEST(RecordedMotion, ConstantAccelerationIsExact) {
  const RecordedMotion motion(history_of(MotionRecord::acceleration, {0.0, 4.0}, {2.0, 2.0}));
  EXPECT_EQ(motion.displacement(3.0).x(), 9.0);
  EXPECT_EQ(motion.velocity(3.0).x(), 6.0);
}

TEST(RecordedMotion, VelocityIsTheRecordAndStaysAfterIt) {
  const RecordedMotion motion(history_of(MotionRecord::velocity, {1.0, 3.0}, {1.0, 2.0}));
  EXPECT_EQ(motion.velocity(0.5).x(), 0.0);
  EXPECT_EQ(motion.velocity(2.0).x(), 1.5);
  EXPECT_EQ(motion.displacement(3.0).x(), 3.0);
  EXPECT_EQ(motion.velocity(5.0).x(), 2.0);
  EXPECT_EQ(motion.displacement(5.0).x(), 7.0);
}

TEST(RecordedMotion, SplineGoesThroughItsRowsWithContinuousAcceleration) {
  const RecordedMotion motion(history_of(MotionRecord::smooth_displacement, times, values));
  constexpr double little = 1e-9;
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_NEAR(motion.displacement(times[k]).x(), values[k], 1e-13);
    const bool is_end = k == 0 || k + 1 == times.size();
    EXPECT_NEAR(motion.velocity(times[k]).x(), motion.velocity(times[k] - little).x(), 1e-4) << k;
    if (is_end) {
      EXPECT_NEAR(motion.velocity(times[k]).x(), 0.0, 1e-12);
    } else {
      EXPECT_NEAR(motion.acceleration(times[k]).x(), motion.acceleration(times[k] - little).x(), 1e-2) << k;
    }
  }
  // Its velocity is the derivative of its displacement.
  for (const double t : {0.53, 0.9, 1.12, 1.7})
    EXPECT_NEAR((motion.displacement(t + 1e-5).x() - motion.displacement(t - 1e-5).x()) / 2e-5,
                motion.velocity(t).x(), 1e-4);
  EXPECT_EQ(motion.displacement(0.0).x(), values.front());
  EXPECT_EQ(motion.displacement(3.0).x(), values.back());
}

TEST(RecordedMotion, SplineConverges) {
  // A motion from rest to rest: u = (1 - cos t)^2, of which a clamped spline leaves O(h^4).
  const auto error = [](int count) {
    SupportHistory history{{}, {}, MotionRecord::smooth_displacement};
    const double length = 2.0 * M_PI;
    for (int k = 0; k <= count; ++k) {
      const double t = length * k / count;
      history.times.push_back(t);
      history.values.emplace_back(std::pow(1.0 - std::cos(t), 2), 0, 0);
    }
    const RecordedMotion motion(history);
    double most = 0.0;
    for (double t = 0.0; t < length; t += 0.01)
      most = std::max(most, std::abs(motion.displacement(t).x() - std::pow(1.0 - std::cos(t), 2)));
    return most;
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4.0, 0.5);
}

TEST(RecordedMotion, NaturalSplineOfALineIsTheLine) {
  const std::vector<Vector3> slopes =
      spline_slopes({0.0, 1.0, 1.5, 4.0}, {{0, 0, 0}, {2, 0, 0}, {3, 0, 0}, {8, 0, 0}}, SplineEnds::natural);
  for (const Vector3& slope : slopes) EXPECT_NEAR(slope.x(), 2.0, 1e-13);
}

TEST(RecordedMotion, LinesHaveNoVelocityOfTheirOwn) {
  EXPECT_FALSE(RecordedMotion(history_of(MotionRecord::displacement, times, values)).smooth());
  EXPECT_TRUE(RecordedMotion(history_of(MotionRecord::velocity, times, values)).smooth());
}

TEST(RecordedMotion, ChangesWhileItMoves) {
  const RecordedMotion motion(history_of(MotionRecord::velocity, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}));
  EXPECT_FALSE(motion.changes_between(0.0, 1.0));
  EXPECT_TRUE(motion.changes_between(0.0, 1.5));
  EXPECT_TRUE(motion.changes_between(2.5, 2.6));
  EXPECT_FALSE(motion.changes_between(3.0, 9.0));
}

TEST(RecordedMotion, RefusesWhatIsNotFinite) {
  EXPECT_THROW(RecordedMotion(history_of(MotionRecord::acceleration, {0.0, 1e200}, {1.0, 1.0})),
               std::domain_error);
  EXPECT_THROW(RecordedMotion(history_of(MotionRecord::velocity, {0.0, 1e-300}, {0.0, 1e10})),
               std::domain_error);
}

}  // namespace
}  // namespace ashlar::recorded_motion_test

// The curve of Bandis: closed forms, and energies against quadrature.
#include "mechanics/contact/laws/normal_spring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mechanics/basis/quadrature.hpp"

namespace ashlar::normal_spring_test {
namespace {

constexpr double stiffness = 2e9, largest = 3e-4;
constexpr NormalSpring curved{stiffness, largest};

TEST(NormalSpring, LinearWithoutALargestClosure) {
  const NormalSpring linear{stiffness};
  EXPECT_FALSE(linear.stiffens());
  EXPECT_EQ(linear.force(1e-4), 2e5);
  EXPECT_EQ(linear.force(-1e-4), -2e5);
  EXPECT_EQ(linear.slope(1e-4), stiffness);
  EXPECT_EQ(linear.energy(1e-4), 10.0);
  EXPECT_EQ(linear.closure(2e5), 1e-4);
}

TEST(NormalSpring, HalfTheLargestClosureDoublesTheForceOfTheInitialStiffness) {
  EXPECT_TRUE(curved.stiffens());
  EXPECT_DOUBLE_EQ(curved.force(0.5 * largest), stiffness * largest);
  EXPECT_DOUBLE_EQ(curved.slope(0.5 * largest), 4.0 * stiffness);
  // k v^2 (ln 2 - 1/2)
  EXPECT_NEAR(curved.energy(0.5 * largest), stiffness * largest * largest * (std::log(2.0) - 0.5),
              1e-13 * 180.0);
  EXPECT_DOUBLE_EQ(curved.force(-1e-4), -1e-4 * stiffness);
  EXPECT_DOUBLE_EQ(curved.energy(-1e-4), 0.5e-8 * stiffness);
}

TEST(NormalSpring, GoesOnAlongItsTangentNearTheLargestClosure) {
  const double end = 0.99 * largest;
  const double at_end = 99.0 * stiffness * largest;
  EXPECT_NEAR(curved.force(end), at_end, 1e-12 * at_end);
  EXPECT_NEAR(curved.slope(end), 1e4 * stiffness, 1e-9 * stiffness);
  EXPECT_NEAR(curved.force(2.0 * largest), at_end + 1e4 * stiffness * 1.01 * largest, 1e-10 * at_end);
  EXPECT_DOUBLE_EQ(curved.slope(2.0 * largest), curved.slope(end));
}

TEST(NormalSpring, ClosureIsTheInverseOfTheForce) {
  for (const double x : {-0.5, 0.0, 1e-9, 0.1, 0.7, 0.98, 0.999, 3.0})
    EXPECT_NEAR(curved.closure(curved.force(x * largest)), x * largest, 1e-12 * largest) << x;
}

TEST(NormalSpring, EnergyIsTheIntegralOfTheForce) {
  // Small closures are those of k c^2/2 (1 + 2 x/3 + x^2/2 + ...).
  for (const double x : {1e-8, 1e-4, 1e-3}) {
    const double closure = x * largest;
    EXPECT_NEAR(curved.energy(closure) / (0.5 * stiffness * closure * closure),
                1.0 + 2.0 * x / 3.0 + 0.5 * x * x, x * x * x + 1e-15);
  }
  // Simpson's rule with 2000 intervals.
  for (const double x : {0.03, 0.2, 0.6, 0.9, 1.2}) {
    constexpr int intervals = 2000;
    const double kink = 0.99 * largest, to = x * largest;
    double sum = 0.0;
    for (const auto& [low, high] : {std::pair(0.0, std::min(to, kink)), {std::min(to, kink), to}})
      for (int k = 0; k <= 2 * intervals; ++k) {
        const double weight = k == 0 || k == 2 * intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
        sum += weight * (high - low) / (6.0 * intervals) *
               curved.force(low + (high - low) * k / (2.0 * intervals));
      }
    EXPECT_NEAR(curved.energy(to), sum, (x > 0.9 ? 1e-6 : 1e-11) * sum) << x;
  }
}

TEST(NormalSpring, RulesOfTheNeededDegreeHaveForceAndMoment) {
  EXPECT_EQ(NormalSpring{stiffness}.needed_degree(0.0, 1.0), 0);
  EXPECT_EQ(curved.needed_degree(-2.0 * largest, -0.1 * largest), 0);
  EXPECT_EQ(curved.needed_degree(0.5 * largest, 0.5 * largest), 0);
  int last = 1;
  for (const double to : {0.2, 0.4, 0.6, 0.8, 0.9}) {
    const double from = 0.1 * largest;
    const double reach = to * largest - from;
    const int degree = curved.needed_degree(from, to * largest);
    EXPECT_GE(degree, last);
    last = degree;
    const SegmentRule rule = gauss_legendre(degree / 2 + 1), fine = gauss_legendre(60);
    const auto moment_of = [&](const SegmentRule& of, double lever) {
      double sum = 0.0;
      for (std::size_t k = 0; k < of.points.size(); ++k)
        sum += of.weights[k] * std::pow(2.0 * of.points[k] - 1.0, lever) *
               curved.force(from + of.points[k] * reach);
      return sum;
    };
    const double force = moment_of(fine, 0.0);
    for (const double lever : {0.0, 1.0})
      EXPECT_NEAR(moment_of(rule, lever), moment_of(fine, lever), 2e-3 * force) << to;
  }
  EXPECT_LE(curved.needed_degree(0.0, 5.0 * largest), 17);
}

TEST(NormalSpring, ClosureIsToldAsAShareOfTheLargest) {
  EXPECT_DOUBLE_EQ(curved.closed_share(1.5e-4), 0.5);
  EXPECT_EQ(NormalSpring{stiffness}.closed_share(1.5e-4), 0.0);
}

TEST(NormalSpring, TheMeanForceDoesTheWorkOfTheEnergy) {
  std::mt19937_64 random(3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const double from = largest * uniform(-0.3, 1.1);
    const double to =
        trial % 2 == 0 ? largest * uniform(-0.3, 1.1) : from + largest * std::pow(10.0, uniform(-9.0, -2.0));
    const MeanCompression mean = curved.mean_compression(from, to);
    const auto held = [](double closure) { return closure > 0.0 ? curved.energy(closure) : 0.0; };
    EXPECT_NEAR(mean.force * (to - from), held(to) - held(from), 1e-13 * (held(to) + held(from)));
    EXPECT_GE(mean.slope, 0.0);
    const double step = 1e-6 * largest;
    const double ahead = curved.mean_compression(from, to + step).force;
    const double back = curved.mean_compression(from, to - step).force;
    EXPECT_NEAR(mean.slope, (ahead - back) / (2.0 * step), 2e-3 * mean.slope + 1e-6 * stiffness)
        << from / largest << " to " << to / largest;
  }
}

// The mean differs from the force in the middle by a share (d / left)^2 / 12: a difference of energies would differ by
// rounding error over the share of the change.
TEST(NormalSpring, TheMeanOverASmallChangeIsTheForceInItsMiddle) {
  for (const double share : {0.001, 0.1, 0.5, 0.9, 0.98, 1.2}) {
    for (const double change : {1e-9, 1e-11, 1e-13, 1e-15}) {
      const double from = share * largest;
      const double to = from + change * largest;
      const double middle = curved.force(0.5 * (from + to));
      EXPECT_NEAR(curved.mean_compression(from, to).force, middle, 1e-13 * middle)
          << share << " by " << change;
      EXPECT_NEAR(curved.mean_compression(to, from).force, middle, 1e-13 * middle)
          << share << " by " << change;
    }
  }
}

}  // namespace
}  // namespace ashlar::normal_spring_test

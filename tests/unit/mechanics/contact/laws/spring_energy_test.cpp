#include "mechanics/contact/laws/spring_energy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ashlar::spring_energy_test {
namespace {

/// Linear springs.
std::vector<NormalSpring> springs(const std::vector<double>& stiffnesses) {
  std::vector<NormalSpring> result;
  for (const double stiffness : stiffnesses) result.push_back({stiffness});
  return result;
}

TEST(SpringEnergy, RestOfOneSpringIsWhereItHoldsAsMuch) {
  // 2/2 * 3^2 = 9 J at rest 0; 4 J at a depth of 2.
  EXPECT_DOUBLE_EQ(rest_gap(springs({2.0}), {-3.0}, 4.0), -1.0);
  EXPECT_EQ(rest_gap(springs({2.0}), {-3.0}, 9.0), 0.0);
  EXPECT_EQ(rest_gap(springs({2.0}), {-3.0}, 20.0), 0.0);
  EXPECT_EQ(rest_gap(springs({2.0}), {-3.0}, std::numeric_limits<double>::infinity()), 0.0);
}

TEST(SpringEnergy, SpringsThatHeldNothingRestAtTheDeepest) {
  EXPECT_EQ(rest_gap(springs({1.0, 1.0, 5.0}), {-1.0, -3.0, 2.0}, 0.0), -3.0);
  EXPECT_EQ(rest_gap(springs({1.0, 5.0}), {1.0, 2.0}, 0.0), 0.0);
  EXPECT_EQ(rest_gap(springs({1.0, 5.0}), {1.0, 2.0}, 1.0), 0.0);
}

TEST(SpringEnergy, SpringsLeaveOneByOne) {
  // At rest -1/2: depths 1/2 and 5/2. At rest -3/2 only the second is left, 3/2 deep.
  EXPECT_NEAR(rest_gap(springs({1.0, 1.0}), {-1.0, -3.0}, 0.5 * (0.25 + 6.25)), -0.5, 1e-15);
  EXPECT_NEAR(rest_gap(springs({1.0, 1.0}), {-1.0, -3.0}, 1.125), -1.5, 1e-15);
}

TEST(SpringEnergy, RandomSpringsHoldWhatTheyHeldWhateverTheUnits) {
  std::mt19937_64 random(20);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  for (int trial = 0; trial < 1000; ++trial) {
    const double length = std::ldexp(1.0, static_cast<int>(random() % 60) - 40);
    std::vector<double> stiffnesses, gaps;
    for (int k = 0; k < 7; ++k) {
      stiffnesses.push_back(std::ldexp(uniform(0.1, 1.0), static_cast<int>(random() % 20)));
      gaps.push_back(length * uniform(-1.0, 0.3));
    }
    const auto energy = [&](double rest) {
      double sum = 0.0;
      for (std::size_t k = 0; k < gaps.size(); ++k)
        sum += rest > gaps[k] ? 0.5 * stiffnesses[k] * (rest - gaps[k]) * (rest - gaps[k]) : 0.0;
      return sum;
    };
    const double held = energy(0.0) * uniform(0.0, 1.0);
    const double rest = rest_gap(springs(stiffnesses), gaps, held);
    EXPECT_NEAR(energy(rest), held, 1e-12 * energy(0.0)) << trial;
    EXPECT_LE(rest, 0.0);
  }
}

TEST(SpringEnergy, RestsAreOnTheSurfaceWhereThatIsNoGain) {
  // 1/2 * 1 + 1/2 * 4 = 2.5 J on the surface.
  EXPECT_EQ(rest_gaps(springs({1.0, 1.0}), {-1.0, -2.0}, {-0.5, -1.0}, 2.5), (std::vector<double>{0.0, 0.0}));
}

TEST(SpringEnergy, APointFoundDeepStartsWithoutForce) {
  // The first spring held 1/2 J and still does; the second one has no memory.
  EXPECT_EQ(rest_gaps(springs({1.0, 4.0}), {-1.0, -3.0}, {0.0, -3.0}, 0.5), (std::vector<double>{0.0, -3.0}));
}

TEST(SpringEnergy, ASpringThatIsOpenIsAtRestWhereItIs) {
  // The second one was known to be open by 3 m; whether the first holds as much as before to the last bit
  // does not matter.
  for (const double held : {0.5, 0.5 * (1.0 + 1e-15), 0.5 * (1.0 - 1e-15)}) {
    const std::vector<double> rests = rest_gaps(springs({1.0, 4.0}), {-1.0, -3.0}, {0.0, -6.0}, held);
    EXPECT_NEAR(rests[0], 0.0, 1e-14);
    EXPECT_NEAR(rests[1], -3.0, 1e-14);
  }
}

TEST(SpringEnergy, RestsMoveBackAsFarAsTheEnergyAllows) {
  // With a share s of the remembered rest the second spring is 3 - 3 s deep: 1/2 + 2 (3 - 3 s)^2 J, 5 J at
  // 1/2.
  const std::vector<double> rests = rest_gaps(springs({1.0, 4.0}), {-1.0, -3.0}, {0.0, -3.0}, 5.0);
  EXPECT_EQ(rests[0], 0.0);
  EXPECT_NEAR(rests[1], -1.5, 1e-15);
}

TEST(SpringEnergy, RestsThatHoldWhatTheyHeldStay) {
  // Both 1 m deep, 5/2 J, repeatedly: rounding of their energy does not move them.
  std::vector<double> rests = {-1.0, -2.0};
  for (int step = 0; step < 100; ++step)
    rests = rest_gaps(springs({1.0, 4.0}), {-2.0, -3.0}, rests, 2.5 * (1.0 + 1e-16 * (step % 3 - 1)));
  EXPECT_NEAR(rests[0], -1.0, 1e-13);
  EXPECT_NEAR(rests[1], -2.0, 1e-13);
}

TEST(SpringEnergy, RestsGoBelowWhatIsRememberedWhereThatHoldsTooMuch) {
  // Both remembered 2 m deep, 4 J in all; 1 J is where both are 1 m deep.
  const std::vector<double> rests = rest_gaps(springs({1.0, 1.0}), {-2.0, -5.0}, {0.0, -3.0}, 1.0);
  EXPECT_NEAR(rests[0], -1.0, 1e-15);
  EXPECT_NEAR(rests[1], -4.0, 1e-15);
}

TEST(SpringEnergy, SpringsThatStiffenHoldWhatTheyHeld) {
  const std::vector<NormalSpring> curved = {{2.0, 1.0}, {1.0}, {3.0, 0.5}};
  const std::vector<double> gaps = {-0.9, -0.4, -0.6};
  const auto energy_at = [&](const std::vector<double>& rests) {
    double sum = 0.0;
    for (std::size_t k = 0; k < curved.size(); ++k)
      if (rests[k] > gaps[k]) sum += curved[k].energy(rests[k] - gaps[k]);
    return sum;
  };
  const double all = energy_at({0.0, 0.0, 0.0});
  EXPECT_EQ(rest_gap(curved, gaps, all), 0.0);
  for (const double held : {0.9 * all, 0.1 * all, 1e-3, 1e-12}) {
    const double rest = rest_gap(curved, gaps, held);
    EXPECT_NEAR(energy_at({rest, rest, rest}), held, 1e-9 * held);
    EXPECT_NEAR(energy_at(rest_gaps(curved, gaps, {-0.5, 0.0, -0.55}, held)), held, 1e-9 * held);
  }
}

}  // namespace
}  // namespace ashlar::spring_energy_test

// Kinematic checks of mechanisms by hand.
#include "apps/run/answers/kinematic_check.hpp"
#include "apps/run/answers/pushover_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ashlar::kinematic_check_test {
namespace {

using ::testing::HasSubstr;

constexpr double g = 9.81;

/// A line from 0.2 to zero at 0.5 m, of two blocks of which the second one moves half as far.
Pushover two_blocks() {
  Pushover path;
  path.end = PushoverEnd::zero;
  path.zero = 0.5;
  for (int k = 0; k <= 10; ++k) path.places.push_back({0.05 * k, 0.2 * (1.0 - 0.1 * k), {0, 1}});
  path.mechanism = {{0, 3000.0, 1.2}, {1, 6000.0, 0.6}};
  path.activation = 0.2;
  path.at_limit = true;
  return path;
}

SceneSpectrum constant(double acceleration) {
  SceneSpectrum spectrum;
  spectrum.source = SceneSpectrum::Source::points;
  spectrum.points = {{0.0, acceleration}};
  return spectrum;
}

TEST(KinematicCheck, HasTheMassThatTakesPart) {
  ScenePushover asked;
  asked.confidence_factor = 1.2;
  const auto check = kinematic_check(two_blocks(), asked, {}, g);
  ASSERT_TRUE(check);
  const double first = 3000.0 * 1.2 + 6000.0 * 0.6, second = 3000.0 * 1.44 + 6000.0 * 0.36;
  const KinematicCapacity& capacity = check->capacity;
  EXPECT_NEAR(capacity.mass, first * first / (g * second), 1e-9);
  EXPECT_NEAR(capacity.mass_fraction, first * first / (9000.0 * second), 1e-12);
  EXPECT_NEAR(capacity.acceleration, 0.2 * g / (capacity.mass_fraction * 1.2), 1e-12);
  EXPECT_NEAR(capacity.displacement_ratio, second / first, 1e-12);
  EXPECT_NEAR(*capacity.ultimate, 0.4 * 0.5 * second / first, 1e-12);
  EXPECT_NEAR(*capacity.secant, 0.16 * 0.5 * second / first, 1e-12);
  EXPECT_NEAR(*capacity.secant_acceleration, 0.84 * capacity.acceleration, 1e-12);
  EXPECT_NEAR(*capacity.secant_period,
              2.0 * std::numbers::pi * std::sqrt(*capacity.secant / *capacity.secant_acceleration), 1e-12);
  EXPECT_FALSE(check->demand);
  EXPECT_EQ(verdict_of(*check), "no demand");
}

// Blocks move before joints would dilate: a smaller multiplier, all mass, and no displacements.
TEST(KinematicCheck, OfBlocksThatMoveBeforeTheLimitIsOnTheSafeSide) {
  Pushover path = two_blocks();
  path.activation = 0.15;
  path.at_limit = false;
  ScenePushover asked;
  asked.confidence_factor = 1.2;
  const auto check = kinematic_check(path, asked, constant(1.0), g);
  ASSERT_TRUE(check);
  EXPECT_EQ(check->capacity.mass_fraction, 1.0);
  EXPECT_NEAR(check->capacity.acceleration, 0.15 * g / 1.2, 1e-12);
  EXPECT_FALSE(check->capacity.ultimate || check->capacity.secant_period || check->capacity.zero);
  ASSERT_TRUE(check->demand);
  EXPECT_TRUE(check->demand->linear && !check->demand->nonlinear);
}

TEST(KinematicCheck, ComparesWithADemandOnTheGroundAndAbove) {
  ScenePushover asked;
  asked.height = 6.0;
  asked.building_height = 9.0;
  asked.storeys = 2;
  asked.period = 0.5;
  const auto check = kinematic_check(two_blocks(), asked, constant(1.0), g);
  ASSERT_TRUE(check && check->demand);
  EXPECT_EQ(check->confidence_factor, 1.35);
  const KinematicDemand& demand = *check->demand;
  const double amplified = 6.0 / 9.0 * 6.0 / 5.0;
  EXPECT_NEAR(demand.linear->demand, 0.5, 1e-12);
  EXPECT_NEAR(demand.linear_above->demand, 0.5 * amplified, 1e-12);
  const double period = *check->capacity.secant_period, ratio = period / 0.5;
  EXPECT_NEAR(demand.nonlinear->demand, std::pow(period / (2.0 * std::numbers::pi), 2), 1e-12);
  EXPECT_NEAR(demand.nonlinear_above->demand,
              std::pow(0.5 / (2.0 * std::numbers::pi), 2) * amplified * ratio * ratio /
                  std::sqrt(std::pow(1.0 - ratio, 2) + 0.02 * ratio),
              1e-12);
  EXPECT_EQ(verdict_of(*check), "satisfied");
  const nlohmann::ordered_json json = kinematic_summary(*check);
  EXPECT_EQ(json.at("verdict"), "satisfied");
  EXPECT_TRUE(json.at("demand").at("nonlinear_at_height").at("satisfied").get<bool>());
  EXPECT_EQ(json.at("du_star"), *check->capacity.ultimate);
  EXPECT_EQ(verdict_of(*kinematic_check(two_blocks(), asked, constant(100.0), g)), "not satisfied");
}

TEST(KinematicCheck, WithoutAZeroIsLinear) {
  Pushover path = two_blocks();
  path.end = PushoverEnd::reaches_limit;
  path.zero.reset();
  const auto check = kinematic_check(path, {}, constant(1.0), g);
  ASSERT_TRUE(check && check->demand);
  EXPECT_FALSE(check->capacity.ultimate);
  EXPECT_FALSE(check->demand->nonlinear);
  EXPECT_EQ(verdict_of(*check), "satisfied");
  EXPECT_TRUE(kinematic_summary(*check).at("period_secant").is_null());
  path.mechanism.clear();
  EXPECT_FALSE(kinematic_check(path, {}, {}, g));
}

TEST(KinematicCheck, IsATableToPaste) {
  const std::string table = kinematic_table(*kinematic_check(two_blocks(), {}, constant(1.0), g));
  EXPECT_THAT(table, HasSubstr("quantity,symbol,value,unit,equation\n"));
  EXPECT_THAT(table, HasSubstr("multiplier of activation,alpha_0,0.2,1,\n"));
  EXPECT_THAT(table, HasSubstr("linear on the ground: demand,,0.5,m/s^2,8\n"));
  EXPECT_THAT(table, HasSubstr("non-linear on the ground: verdict,,satisfied,,10\n"));
}

TEST(KinematicCheck, AsksForTheDisplacementsThatItNeeds) {
  const std::vector<double> shares = shares_of_check();
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_NEAR(shares[0], 0.16, 1e-15);
  EXPECT_EQ(shares[1], 0.4);
}

}  // namespace
}  // namespace ashlar::kinematic_check_test

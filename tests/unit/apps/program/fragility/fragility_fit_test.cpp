// Fits of fragility curves against closed forms.
#include "apps/program/fragility/fragility_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace ashlar::fragility_fit_test {
namespace {

using ::testing::HasSubstr;

// Of tables of the normal distribution.
constexpr double three_quarters = 0.6744897501960817;  // Phi of this is 0.75
constexpr double density_there = 0.31777657;           // phi of this
constexpr double quantile_975 = 1.959963984540054;

/// `all` runs at an intensity, of which some exceed the limit, each of a record of its own.
void add(std::vector<FragilityRun>& runs, double intensity, std::size_t all, std::size_t exceeded) {
  for (std::size_t k = 0; k < all; ++k) runs.push_back({intensity, k < exceeded, runs.size()});
}

TEST(FragilityFit, LikelihoodIsThatOfTheNormalDistribution) {
  // Phi(1) = 0.841344746, Phi(-1) = 0.158655254, Phi(0) = 1/2, at m exp(s), m exp(-s) and m.
  const double m = 3.0, s = 0.4;
  const std::vector<FragilityRun> runs = {
      {m * std::exp(s), true, 0}, {m * std::exp(s), false, 1}, {m * std::exp(-s), true, 2}, {m, true, 3}};
  EXPECT_NEAR(log_likelihood(runs, m, s),
              std::log(0.8413447460685429) + 2.0 * std::log(0.15865525393145707) + std::log(0.5), 1e-12);
}

TEST(FragilityFit, LikelihoodOfTheFarTailIsFinite) {
  // Phi(-40) = phi(40) / 40 (1 - 1/40^2 + 3/40^4 - ...): below the range of double precision.
  const double logarithm =
      -800.0 - 0.5 * std::log(2.0 * M_PI) - std::log(40.0) + std::log(1.0 - 1.0 / 1600.0 + 3.0 / 2560000.0);
  EXPECT_NEAR(log_likelihood({{std::exp(-4.0), true, 0}}, 1.0, 0.1), logarithm, 1e-8);
  // Both branches are one function, with the slope phi / Phi = 30.0333 (30 + 1 / 30 - 2 / 30^3) at -30.
  EXPECT_NEAR(log_likelihood({{std::exp(-2.99999), true, 0}}, 1.0, 0.1) -
                  log_likelihood({{std::exp(-3.00001), true, 0}}, 1.0, 0.1),
              2e-4 * (30.0 + 1.0 / 30.0 - 2.0 / 27000.0), 1e-6);
}

TEST(FragilityFit, TwoIntensitiesAreMetExactly) {
  // Shares 1/4 and 3/4 at x and 2 x: the line of largest likelihood goes through both, q = -+ 0.6745.
  std::vector<FragilityRun> runs;
  add(runs, 1.5, 40, 10);
  add(runs, 3.0, 40, 30);
  const FragilityFit fit = fit_fragility(runs);
  ASSERT_EQ(fit.status, FragilityStatus::fitted);
  EXPECT_NEAR(*fit.median, 1.5 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(*fit.dispersion, std::log(2.0) / (2.0 * three_quarters), 1e-9);
  EXPECT_NEAR(*fit.likelihood, 60.0 * std::log(0.75) + 20.0 * std::log(0.25), 1e-9);
  EXPECT_NEAR(*fit.likelihood, log_likelihood(runs, *fit.median, *fit.dispersion), 1e-9);
  EXPECT_NEAR(*fit.probability(1.5), 0.25, 1e-9);
  EXPECT_NEAR(*fit.probability(3.0), 0.75, 1e-9);
}

TEST(FragilityFit, BoundsAreThoseOfFishersInformation) {
  // Independent runs: each q of the two intensities has the variance v = p (1 - p) / (n phi^2); ln m is where their line is
  // zero, with the variance v / 2 / b^2, b = 1 / s; b has 2 v / D^2, D = ln 2. Equation (6) has K / (K - 1), K = 80.
  std::vector<FragilityRun> runs;
  add(runs, 1.5, 40, 10);
  add(runs, 3.0, 40, 30);
  const FragilityFit fit = fit_fragility(runs);
  const double v = 0.25 * 0.75 / (40.0 * density_there * density_there) * 80.0 / 79.0, s = *fit.dispersion;
  const double of_median = std::exp(quantile_975 * std::sqrt(0.5 * v) * s);
  EXPECT_NEAR(fit.median_bounds->low, *fit.median / of_median, 1e-6);
  EXPECT_NEAR(fit.median_bounds->high, *fit.median * of_median, 1e-6);
  const double of_dispersion = std::exp(quantile_975 * std::sqrt(2.0 * v) / std::log(2.0) * s);
  EXPECT_NEAR(fit.dispersion_bounds->low, s / of_dispersion, 1e-6);
  EXPECT_NEAR(fit.dispersion_bounds->high, s * of_dispersion, 1e-6);
  // At an intensity with runs the bounds are those of its q.
  const double q = quantile_975 * std::sqrt(v);
  EXPECT_NEAR(fit.probability_bounds(3.0)->low, 0.5 * std::erfc(-(three_quarters - q) / std::sqrt(2.0)),
              1e-6);
  EXPECT_NEAR(fit.probability_bounds(3.0)->high, 0.5 * std::erfc(-(three_quarters + q) / std::sqrt(2.0)),
              1e-6);
}

TEST(FragilityFit, NoUnitOfIntensityIsPreferred) {
  std::vector<FragilityRun> runs, others;
  for (int k = 0; k < 60; ++k) {
    const double x = 0.1 * (1 + k % 10);
    runs.push_back({x, (k * 7) % 11 < k % 10, static_cast<std::size_t>(k / 10)});
    others.push_back({9.81 * x, runs.back().exceeded, runs.back().record});
  }
  const FragilityFit fit = fit_fragility(runs), other = fit_fragility(others);
  ASSERT_EQ(fit.status, FragilityStatus::fitted);
  EXPECT_NEAR(*other.median, 9.81 * *fit.median, 1e-8);
  EXPECT_NEAR(*other.dispersion, *fit.dispersion, 1e-9);
  EXPECT_NEAR(other.median_bounds->high, 9.81 * fit.median_bounds->high, 1e-7);
  EXPECT_NEAR(other.probability_bounds(4.0)->low, fit.probability_bounds(4.0 / 9.81)->low, 1e-9);
}

// Records that exceed a limit at an intensity of their own, from a lognormal distribution, each run at eight scales.
TEST(FragilityFit, BoundsHoldTheMedianOfRecordsThatAreRunAtSeveralScales) {
  constexpr int trials = 300, records = 25;
  constexpr double median = 2.0, dispersion = 0.4;
  std::mt19937_64 numbers(1);
  std::normal_distribution<double> normal;
  int held = 0;
  double mean = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<FragilityRun> runs;
    for (std::size_t record = 0; record < records; ++record) {
      const double capacity = median * std::exp(dispersion * normal(numbers));
      for (int k = 1; k <= 8; ++k) runs.push_back({0.5 * k, 0.5 * k > capacity, record});
    }
    const FragilityFit fit = fit_fragility(runs);
    ASSERT_EQ(fit.status, FragilityStatus::fitted);
    held += fit.median_bounds->low <= median && median <= fit.median_bounds->high ? 1 : 0;
    mean += *fit.dispersion / trials;
  }
  // 95 % but for 2.4 standard deviations of 300 trials, and 2 % that 25 records lack of many.
  EXPECT_GE(held, 0.90 * trials);
  EXPECT_LE(held, 0.98 * trials);
  EXPECT_NEAR(mean, dispersion, 0.05 * dispersion);
}

TEST(FragilityFit, ASingleRecordHasNoConfidence) {
  const FragilityFit fit = fit_fragility({{1, false, 0}, {2, true, 0}, {3, false, 0}, {4, true, 0}});
  EXPECT_EQ(fit.status, FragilityStatus::fitted);
  EXPECT_FALSE(fit.median_bounds);
  EXPECT_FALSE(fit.probability_bounds(2.0));
  EXPECT_THAT(describe(fit, " m/s^2"), HasSubstr("without confidence: a single record"));
}

TEST(FragilityFit, SeparatedOutcomesBoundTheDispersion) {
  // Five runs survive at 2, five exceed at 3. With s the best median is sqrt(6), 2 L = 20 ln Phi(ln(1.5) / (2 s)) >= -c^2:
  // Phi = exp(-c^2 / 20) = 0.825261 at 0.9356.
  std::vector<FragilityRun> runs;
  add(runs, 2.0, 5, 0);
  add(runs, 3.0, 5, 5);
  const FragilityFit fit = fit_fragility(runs);
  EXPECT_EQ(fit.status, FragilityStatus::separated);
  EXPECT_NEAR(*fit.median, std::sqrt(6.0), 1e-12);
  EXPECT_DOUBLE_EQ(fit.median_bounds->low, 2.0);
  EXPECT_DOUBLE_EQ(fit.median_bounds->high, 3.0);
  EXPECT_FALSE(fit.dispersion);
  EXPECT_EQ(fit.dispersion_bounds->low, 0.0);
  const double q = std::log(1.5) / (2.0 * fit.dispersion_bounds->high);
  EXPECT_NEAR(std::log(0.5 * std::erfc(-q / std::sqrt(2.0))), -quantile_975 * quantile_975 / 20.0, 1e-6);
  EXPECT_EQ(fit.probability(2.4), 0.0);
  EXPECT_EQ(fit.probability(2.5), 1.0);
  EXPECT_THAT(describe(fit, ""), HasSubstr("median between 2 and 3: no run below exceeds it"));
}

TEST(FragilityFit, BothOutcomesAtTheIntensityBetweenAreSeparatedToo) {
  std::vector<FragilityRun> runs;
  add(runs, 1.0, 6, 0);
  add(runs, 2.0, 6, 2);
  add(runs, 4.0, 6, 6);
  const FragilityFit fit = fit_fragility(runs);
  EXPECT_EQ(fit.status, FragilityStatus::separated);
  EXPECT_NEAR(*fit.median, 2.0, 1e-12);
  EXPECT_GT(fit.dispersion_bounds->high, 0.1);
  EXPECT_LT(fit.dispersion_bounds->high, 2.0);
}

TEST(FragilityFit, OutcomesWithoutACurveAreTold) {
  std::vector<FragilityRun> none, all, one, falling;
  add(none, 1.0, 4, 0);
  add(none, 2.0, 4, 0);
  add(all, 1.0, 4, 4);
  add(all, 2.0, 4, 4);
  add(one, 1.0, 4, 2);
  add(falling, 1.0, 4, 3);
  add(falling, 2.0, 4, 1);
  EXPECT_EQ(fit_fragility({}).status, FragilityStatus::no_runs);
  EXPECT_EQ(fit_fragility(none).status, FragilityStatus::all_survive);
  EXPECT_EQ(fit_fragility(all).status, FragilityStatus::all_exceed);
  EXPECT_EQ(fit_fragility(one).status, FragilityStatus::one_intensity);
  EXPECT_EQ(fit_fragility(falling).status, FragilityStatus::not_growing);
  EXPECT_THAT(describe(fit_fragility(none), ""), HasSubstr("larger scales are needed"));
  EXPECT_THAT(describe(fit_fragility(all), ""), HasSubstr("smaller scales are needed"));
  for (const auto& runs : {none, all, one, falling}) {
    EXPECT_FALSE(fit_fragility(runs).median);
    EXPECT_FALSE(fit_fragility(runs).probability(1.0));
  }
}

}  // namespace
}  // namespace ashlar::fragility_fit_test

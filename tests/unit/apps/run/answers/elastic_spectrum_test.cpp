// Elastic spectra of codes, by their tables.
#include "apps/run/answers/elastic_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ashlar::elastic_spectrum_test {
namespace {

using Source = SceneSpectrum::Source;

TEST(ElasticSpectrum, OfEurocode8HasItsFourBranches) {
  SceneSpectrum spectrum;
  spectrum.source = Source::ec8;
  spectrum.ground_acceleration = 2.0;
  spectrum.soil = SceneSpectrum::Soil::b;  // S 1.2, TB 0.15, TC 0.5, TD 2
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 0.0), 2.4);
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 0.075), 2.4 * 1.75);
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 0.3), 6.0);
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 1.0), 3.0);
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 4.0), 6.0 * 0.5 * 2.0 / 16.0);
  EXPECT_DOUBLE_EQ(spectral_displacement(spectrum, 1.0), 3.0 / (4.0 * std::numbers::pi * std::numbers::pi));
  spectrum.type = 2;  // S 1.35, TB 0.05, TC 0.25, TD 1.2
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 0.2), 2.0 * 1.35 * 2.5);
  spectrum.damping = 10.0;
  EXPECT_NEAR(spectral_acceleration(spectrum, 0.2), 2.0 * 1.35 * 2.5 * std::sqrt(10.0 / 15.0), 1e-12);
  spectrum.damping = 60.0;
  EXPECT_NEAR(spectral_acceleration(spectrum, 0.2), 2.0 * 1.35 * 2.5 * 0.55, 1e-12) << "the least factor";
}

TEST(ElasticSpectrum, OfNtc2018HasCoefficientsOfTheSoil) {
  SceneSpectrum spectrum;
  spectrum.source = Source::ntc2018;
  spectrum.ground_acceleration = 0.2 * 9.80665;
  spectrum.soil = SceneSpectrum::Soil::c;
  spectrum.amplification = 2.4;
  spectrum.corner_period = 0.3;
  spectrum.topography = 1.2;
  const double ss = 1.7 - 0.6 * 2.4 * 0.2, cc = 1.05 * std::pow(0.3, -0.33);
  const double ground = 0.2 * 9.80665 * ss * 1.2;
  EXPECT_NEAR(spectral_acceleration(spectrum, 0.0), ground, 1e-12);
  EXPECT_NEAR(spectral_acceleration(spectrum, 0.3), 2.4 * ground, 1e-12);
  EXPECT_NEAR(spectral_acceleration(spectrum, 1.0), 2.4 * ground * cc * 0.3, 1e-12);
  const double td = 4.0 * 0.2 + 1.6;
  EXPECT_NEAR(spectral_acceleration(spectrum, 3.0), 2.4 * ground * cc * 0.3 * td / 9.0, 1e-12);
  spectrum.soil = SceneSpectrum::Soil::a;
  EXPECT_NEAR(spectral_acceleration(spectrum, 0.0), 0.2 * 9.80665 * 1.2, 1e-12);
  spectrum.soil = SceneSpectrum::Soil::b;
  EXPECT_NEAR(spectral_acceleration(spectrum, 0.0), 0.2 * 9.80665 * 1.2 * 1.2, 1e-12) << "1.208, at most 1.2";
}

TEST(ElasticSpectrum, OfPointsIsLinearBetweenThem) {
  SceneSpectrum spectrum;
  spectrum.source = Source::points;
  spectrum.points = {{0.1, 2.0}, {0.5, 6.0}, {1.0, 3.0}};
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 0.3), 4.0);
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 0.5), 6.0);
  EXPECT_DOUBLE_EQ(spectral_acceleration(spectrum, 2.0), 3.0);
  EXPECT_EQ(spectral_acceleration({}, 1.0), 0.0);
}

}  // namespace
}  // namespace ashlar::elastic_spectrum_test

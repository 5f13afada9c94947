// Intensities of records.
#include "apps/program/fragility/intensity.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ashlar::intensity_test {
namespace {

using Rows = std::vector<SceneFix::Motion>;

TEST(Intensity, PgaIsTheLargestByItsAmount) {
  EXPECT_DOUBLE_EQ(*intensity_of({}, Rows{{0, {1, 0, 0}}, {1, {-3, 0, 0}}, {2, {2, 0, 0}}}, Vector3::UnitZ()),
                   3.0);
}

TEST(Intensity, OfTwoHorizontalComponentsIsTheirGeometricMean) {
  // sqrt(2 * 8); the vertical one is not counted.
  const Rows rows = {{0, {2, 1, 30}}, {1, {0, -8, 0}}};
  EXPECT_DOUBLE_EQ(*intensity_of({}, rows, Vector3::UnitZ()), 4.0);
  // With gravity along x, y and z are horizontal: sqrt(8 * 30).
  EXPECT_DOUBLE_EQ(*intensity_of({}, rows, -Vector3::UnitX()), std::sqrt(240.0));
}

TEST(Intensity, AVerticalRecordHasThatOfItsComponent) {
  EXPECT_DOUBLE_EQ(*intensity_of({}, Rows{{0, {0, 0, 2}}, {1, {0, 0, -5}}}, Vector3::UnitZ()), 5.0);
}

TEST(Intensity, SpectralAccelerationOfASuddenSteadyOneIsMagnified) {
  // A step of acceleration a: u = -a / w^2 (1 - exp(-z w t) (...)), largest a / w^2 (1 + exp(-pi z / sqrt(1 - z^2))).
  const Rows rows = {{0, {2, 0, 0}}, {10, {2, 0, 0}}};
  const double z = 0.05, overshoot = std::exp(-std::numbers::pi * z / std::sqrt(1.0 - z * z));
  EXPECT_NEAR(*intensity_of(parse_intensity("sa(0.5)"), rows, Vector3::UnitZ()), 2.0 * (1.0 + overshoot),
              1e-3);
}

TEST(Intensity, ScaleHasNoUnit) {
  const IntensityMeasure scale = parse_intensity("scale");
  EXPECT_DOUBLE_EQ(*intensity_of(scale, Rows{{0, {7, 0, 0}}}, Vector3::UnitZ()), 1.0);
  EXPECT_EQ(scale.unit(), "");
  EXPECT_EQ(parse_intensity("sa(0.50)").name(), "sa(0.5)");
}

TEST(Intensity, OfRestIsNone) {
  EXPECT_FALSE(intensity_of({}, Rows{{0, {0, 0, 0}}, {1, {0, 0, 0}}}, Vector3::UnitZ()));
}

TEST(Intensity, UnknownMeasuresAreRefused) {
  for (const char* text : {"PGV", "sa", "sa()", "sa(0)", "sa(-1)", "sa(1", "sa(nan)"})
    EXPECT_THAT([&] { (void)parse_intensity(text); }, ::testing::ThrowsMessage<std::invalid_argument>(
                                                          ::testing::HasSubstr("pga, scale or sa(PERIOD)")))
        << text;
}

}  // namespace
}  // namespace ashlar::intensity_test

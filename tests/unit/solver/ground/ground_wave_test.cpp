#include "solver/ground/ground_wave.hpp"

#include <gmock/gmock.h>

namespace ashlar::ground_wave_test {
namespace {

using ::testing::ElementsAre;

const GroundWave wave{{0.0, 0.5}, {{1, 2, 3}, {-4, 5, 6}}};

TEST(GroundWave, ComponentsAreAlongTheAxes) {
  const WaveVelocity components = components_of(wave);
  EXPECT_THAT(components[0].values, ElementsAre(1, -4));
  EXPECT_THAT(components[1].values, ElementsAre(2, 5));
  EXPECT_THAT(components[2].values, ElementsAre(3, 6));
  for (const History& component : components) EXPECT_THAT(component.times, ElementsAre(0.0, 0.5));
}

TEST(GroundWave, AComponentAlongADirectionIsItsProduct) {
  const History component = component_along(wave, {0, 0.6, 0.8});
  EXPECT_NEAR(component.at(0.0), 0.6 * 2 + 0.8 * 3, 1e-15);
  EXPECT_NEAR(component.at(0.5), 0.6 * 5 + 0.8 * 6, 1e-15);
}

TEST(GroundWave, NoWaveHasNoRows) {
  EXPECT_TRUE(GroundWave().empty());
  EXPECT_FALSE(wave.empty());
  EXPECT_TRUE(components_of({})[0].times.empty());
  EXPECT_TRUE(component_along({}, Vector3::UnitX()).times.empty());
}

}  // namespace
}  // namespace ashlar::ground_wave_test

#include "apps/scene/assemble/quiet_boundaries.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/expand/ground_of_scene.hpp"

namespace ashlar::test::quiet_boundaries_test {
namespace {

/// Rock of c_s = 200 m/s below soil of 100 m/s, 4 m each, between free-field sides.
const std::string ground = R"([analysis]
end_time = 0.2
time_step = 1e-3
integrator = "average-acceleration"
gravity = [0, 0, -10]
initial_state = "static"
[[material]]
name = "rock"
density = 2000
young_modulus = 2e8
poisson_ratio = 0.25
[[material]]
name = "soil"
density = 2000
young_modulus = 5e7
poisson_ratio = 0.25
[[block]]
name = "rock"
material = "rock"
order = 6
box = { min = [0, 0, 0], max = [6, 2, 4] }
[[block]]
name = "soil"
material = "soil"
order = 3
box = { min = [0, 0, 4], max = [6, 2, 8] }
[[boundary]]
plane = { point = [0, 0, 0], normal = [0, 0, -1] }
kind = "quiet"
wave = [[0, 0, 0, 0], [0.05, 0.1, 0, 0.2], [0.1, 0, 0, 0]]
[[boundary]]
plane = { point = [6, 0, 0], normal = [1, 0, 0] }
kind = "free-field"
)";

class QuietScene {
 public:
  explicit QuietScene(const std::string& text = ground) {
    Diagnostics faults;
    loaded_ = load_scene_text(text, "s.toml", {}, faults);
    settings_.integrator = Integrator::average_acceleration;
    settings_.time_step = 1e-3;
    EXPECT_TRUE(faults.good());
  }
  [[nodiscard]] std::vector<QuietFaces> of_block(std::size_t block) const {
    Diagnostics faults;
    const QuietBoundaries boundaries(loaded_->scene, loaded_->solids, settings_, faults);
    return boundaries.of_block(loaded_->scene, loaded_->solids[block], block);
  }
  [[nodiscard]] const LoadedScene& loaded() const { return *loaded_; }

 private:
  std::optional<LoadedScene> loaded_;
  SimulationSettings settings_;
};

TEST(QuietBoundaries, LayersAreThoseOfTheBlocksBeside) {
  const QuietScene scene;
  const Scene& given = scene.loaded().scene;
  const std::vector<GroundBoundary> boundaries = ground_boundaries_of(given);
  ASSERT_EQ(base_of_side(boundaries, 1), 0U);
  const SideLayers layers =
      layers_beside(boundaries[1].plane, boundaries[0].plane, ground_blocks_of(given, scene.loaded().solids));
  EXPECT_FALSE(layers.fault);
  ASSERT_EQ(layers.layers.size(), 2U);
  EXPECT_EQ(layers.layers[0].block, 0U);
  EXPECT_EQ(layers.layers[1].block, 1U);
  EXPECT_NEAR(layers.layers[1].bottom, 4.0, 1e-12);
  EXPECT_NEAR(layers.layers[1].top, 8.0, 1e-12);
}

TEST(QuietBoundaries, ABaseIsHeldCompletelyAndASideAlongItsNormal) {
  const std::vector<QuietFaces> quiet = QuietScene().of_block(0);
  ASSERT_EQ(quiet.size(), 2U);
  EXPECT_EQ(quiet[0].components, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(quiet[1].components, (std::array<bool, 3>{true, false, false}));
  // The wave: across and along, none in y.
  EXPECT_EQ(quiet[0].driving.size(), 2U);
  EXPECT_NEAR(quiet[0].driving[0].vector.x(), 2.0 * 2000.0 * 200.0, 1e-6);
  EXPECT_EQ(QuietScene().of_block(1).size(), 1U);
}

// At the base the column's velocity is the wave until it comes back: the side gets Z w there, on all of its functions.
TEST(QuietBoundaries, AColumnDrivesTheSideWithItsVelocityAndStress) {
  const std::vector<QuietFaces> quiet = QuietScene().of_block(0);
  const double time = 0.015;  // 3 m and 5 m up, and w = 0.03 and 0.06 m/s
  Vector3 traction = Vector3::Zero();
  for (const Load& load : quiet[1].driving) {
    EXPECT_EQ(load.field_degree, 6);
    traction += load.history.at(time) * load.field({6, 1, 0.0});
  }
  // A polynomial rounds the corner at the front of the wave: 3 % here.
  // Upward waves have the strain -w / c: stress on x from P lambda (-w / c_p), on z from S mu (-w / c_s).
  const double mu = 8e7, c_s = 200.0, c_p = c_s * std::sqrt(3.0), rho = 2000.0;
  EXPECT_NEAR(traction.x() / (rho * c_p * 0.03 - mu * 0.06 / c_p), 1.0, 0.05);
  EXPECT_NEAR(traction.z() / (rho * c_s * 0.06 - mu * 0.03 / c_s), 1.0, 0.05);
  EXPECT_NEAR(traction.y(), 0.0, 1e-9);
}

TEST(QuietBoundaries, NothingDrivesASideInStaticsOrWithoutAWave) {
  std::string still = ground;
  still.replace(still.find("wave ="),
                std::string("wave = [[0, 0, 0, 0], [0.05, 0.1, 0, 0.2], [0.1, 0, 0, 0]]").size(), "");
  EXPECT_TRUE(QuietScene(still).of_block(0)[1].driving.empty());
}

TEST(QuietBoundaries, AStageEndsTheWave) {
  const std::string stages =
      ground +
      "[[stage]]\nname = \"rest\"\nanalysis = { type = \"static\" }\n"
      "[[stage]]\nname = \"shake\"\nanalysis = { type = \"dynamic\", end_time = 0.2 }\n"
      "[[stage]]\nname = \"after\"\nanalysis = { type = \"dynamic\", end_time = 0.2 }\n";
  std::string text = stages;
  text.replace(text.find("initial_state = \"static\"\n"), 25, "");
  Diagnostics faults;
  const auto loaded = load_scene_text(text, "s.toml", {}, faults);
  ASSERT_TRUE(loaded);
  EXPECT_FALSE(stage_of(*loaded, 1).scene.boundary[0].wave.empty());
  EXPECT_TRUE(stage_of(*loaded, 2).scene.boundary[0].wave.empty());
}

}  // namespace
}  // namespace ashlar::test::quiet_boundaries_test

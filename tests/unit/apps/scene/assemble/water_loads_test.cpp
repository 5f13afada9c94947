#include "apps/scene/assemble/water_loads.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "apps/scene/assemble/build_simulation.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::water_loads_test {
namespace {

/// Two boxes of 2 x 1 x 3 m side by side, divided at x = 2, on a fixed floor.
const std::string two_boxes = R"([analysis]
type = "static"
[contact]
friction_angle = 30
[[material]]
name = "rock"
density = 2500
young_modulus = 1e9
poisson_ratio = 0.25
[[block]]
name = "floor"
box = { min = [-9, -9, -1], max = [9, 9, 0] }
fixed = true
[[block]]
name = "left"
material = "rock"
box = { min = [0, 0, 0], max = [2, 1, 3] }
[[block]]
name = "right"
material = "rock"
box = { min = [2, 0, 0], max = [4, 1, 3] }
[[water]]
level = { point = [0, 0, 2], normal = [0, 0, 1] }
unit_weight = 1000
)";

class WaterOfScene {
 public:
  explicit WaterOfScene(const std::string& text) : loaded_(load_scene_text(text, "s.toml", {}, faults_)) {
    if (loaded_) water_.emplace(water_pressure_of(*loaded_, faults_));
  }
  /// Total force on a block, N.
  [[nodiscard]] Vector3 force(std::size_t block) const {
    const Load load = water_->of_block(block);
    Vector3 sum = Vector3::Zero();
    for (const PressedPart& part : load.parts) {
      const std::vector<Vector3>& x = part.pressure.corners;
      for (std::size_t k = 1; k + 1 < x.size(); ++k) {
        const double mean =
            (part.pressure.at(x[0]) + part.pressure.at(x[k]) + part.pressure.at(x[k + 1])) / 3;
        sum += 0.5 * (x[k] - x[0]).cross(x[k + 1] - x[0]).norm() * mean * part.direction;
      }
    }
    return sum;
  }
  [[nodiscard]] const WaterPressure& water() const { return *water_; }
  [[nodiscard]] std::string fault() const {
    return faults_.sorted().empty() ? "" : faults_.sorted().front().message;
  }

 private:
  Diagnostics faults_;
  std::optional<LoadedScene> loaded_;
  std::optional<WaterPressure> water_;
};

// All faces below 2 m are pressed: sides cancel, and the floor's joint lifts by 2 m of water over 2 m^2.
TEST(WaterLoads, JointsAndFreeFacesOfABlockUnderWaterLiftIt) {
  const WaterOfScene scene(two_boxes);
  ASSERT_EQ(scene.fault(), "");
  EXPECT_LT((scene.force(1) - Vector3(0, 0, 4000)).norm(), 1e-9);
  EXPECT_TRUE(scene.water().of_block(0).parts.empty());
  EXPECT_NEAR(scene.water().in_joint(1, 2, {2, 0.5, 0.5}), 1500, 1e-9);
  EXPECT_EQ(scene.water().in_joint(1, 2, {2, 0.5, 2.5}), 0.0);
}

// 1/2 h^2 w = 2000 N on each side of a joint between both.
TEST(WaterLoads, OneJointPartsItsBlocks) {
  const WaterOfScene scene(two_boxes + "joints = [\"right\"]\nfaces = []\n");
  ASSERT_EQ(scene.fault(), "");
  EXPECT_LT((scene.force(1) - Vector3(-2000, 0, 0)).norm(), 1e-9);
  EXPECT_LT((scene.force(2) - Vector3(2000, 0, 4000)).norm(), 1e-9);
}

// The free side at x = 0 alone: that at x = 2 is a joint, which is dry.
TEST(WaterLoads, AFaceInADryJointIsNotFree) {
  const WaterOfScene scene(two_boxes + "joints = []\nfaces = [\"left\"]\n");
  ASSERT_EQ(scene.fault(), "");
  EXPECT_LT((scene.force(1) - Vector3(2000, 0, 0)).norm(), 1e-9);
  EXPECT_LT(scene.force(2).norm(), 1e-9);
}

TEST(WaterLoads, TheLastEntryOfAJointCounts) {
  const WaterOfScene scene(two_boxes +
                           "[[water]]\nname = \"low\"\nlevel = { point = [0, 0, 1], normal = [0, 0, 1] }\n"
                           "unit_weight = 1000\njoints = [\"floor\"]\nfaces = []\n");
  ASSERT_EQ(scene.fault(), "");
  EXPECT_LT((scene.force(1) - Vector3(0, 0, 2000)).norm(), 1e-9);
}

TEST(WaterLoads, AStageLowersTheLevel) {
  Diagnostics faults;
  const auto loaded =
      load_scene_text(two_boxes +
                          "[[stage]]\nname = \"full\"\n[[stage]]\nname = \"drawn down\"\n"
                          "[[stage.water]]\nlevel = { point = [0, 0, 0.5], normal = [0, 0, 1] }\n"
                          "unit_weight = 1000\n",
                      "s.toml", {}, faults);
  ASSERT_TRUE(loaded);
  const LoadedScene second = stage_of(*loaded, 1);
  ASSERT_EQ(second.scene.water.size(), 1U);
  EXPECT_NEAR(water_pressure_of(second, faults).in_joint(0, 1, {1, 0.5, 0}), 500, 1e-9);
  EXPECT_NEAR(water_pressure_of(stage_of(*loaded, 0), faults).in_joint(0, 1, {1, 0.5, 0}), 2000, 1e-9);
}

TEST(WaterLoads, FaultsNameTheirPlace) {
  const auto fault = [](const std::string& lines) { return WaterOfScene(two_boxes + lines).fault(); };
  EXPECT_TRUE(fault("joints = [\"lift\"]\n").starts_with("water names no joint (\"lift\")"));
  EXPECT_TRUE(fault("faces = [\"x*\"]\n").starts_with("water names no block (\"x*\")"));
  EXPECT_TRUE(fault("[[water]]\nlevel = { point = [0, 0, 0], normal = [0, 0, 1] }\nunit_weight = 1\n")
                  .starts_with("water named twice (\"water\""));
  EXPECT_TRUE(
      fault("[[water]]\nname = \"b\"\nlevel = { point = [0, 0, 0], normal = [1, 0, 0] }\nunit_weight = 1\n")
          .starts_with("water has no level (the plane of a water level is vertical"));
  EXPECT_TRUE(fault("[[water]]\nname = \"b\"\nlevel = { point = [0, 0, 0], normal = [0, 0, 1] }\n")
                  .starts_with("missing key (unit_weight)"));
}

}  // namespace
}  // namespace ashlar::test::water_loads_test

// Parts of scenes that belong to axes or places.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "apps/scene/assemble/scene_placement.hpp"
#include "apps/scene/assemble/scene_reader.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/scene/assemble/placed_scenes.hpp"

namespace ashlar::scene_placement_refusal_test {
namespace {

using test_support::about_x;
using test_support::about_z;
using test_support::cube;
using test_support::scene_of;
using test_support::start;
using test_support::statics;

/// The reason why a scene cannot be placed; empty: it can be.
std::string refusal(const std::string& text, const ScenePlacement& placement) {
  const TemporaryFolder folder;
  write_text(folder / "points.csv", "x,y,z\n0,0,9\n9,0,9\n0,9,9\n9,9,9\n");
  write_text(folder / "joints.csv", "x,y,z,dip,dip_direction\n0,0,0,30,90\n");
  try {
    (void)placed(scene_of(text, (folder.path() / "scene.toml").string()), placement);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ScenePlacement, SaysWhatBelongsToAxes) {
  ScenePlacement shift;
  shift.shift = {0, 0, 1};
  const std::string weightless = start + "analysis = { type = \"static\", gravity = [0, 0, 0] }\n" + cube;
  const std::string drift = "[[measure]]\nname = \"d\"\ndrift = { blocks = [\"A\"], heights = [1, 5] }\n";
  const std::string plane_cut = "[[cut]]\nname = \"p\"\nblocks = [\"A\"]\ndip = 0\ndip_direction = 0\n";
  const struct {
    std::string text;
    const char* key;
    bool with_a_shift;  ///< a shift is refused too
  } refused[] = {
      {statics + cube + "fix = [{ point = [0, 0, 0], components = [\"x\"] }]\n", "fix.components", false},
      {weightless + drift, "measure.drift.heights", false},
      {weightless + "[initial_stress]\nk0 = 1\nunit_weight = 1\n", "initial_stress.surface", false},
      {weightless + "[[water]]\nlevel = { point = [0, 0, 1], normal = [0, 0, 1] }\nunit_weight = 1\n",
       "water.level", false},
      {statics + cube + "[[water]]\nlevel = { file = \"points.csv\" }\nunit_weight = 1\n", "water.level.file",
       false},
      {statics + cube +
           "[[bolt]]\nname = \"c\"\narea = 1\nbond_stiffness = 1\npattern = { plane = { point = [2, 0, 0], "
           "normal = [1, 0, 0] }, spacing = [1, 2], length = 1 }\n",
       "bolt.pattern", false},
      {statics + cube + plane_cut + "fisher = 20\n", "cut.fisher", false},
      {statics + cube + "[[cut]]\nname = \"p\"\nblocks = [\"A\"]\nfile = \"joints.csv\"\n", "cut.file", true},
      {statics + cube +
           "[[cut]]\nname = \"p\"\nblocks = [\"A\"]\nsolid = { mesh = { file = \"none.obj\" } }\n",
       "cut.solid.mesh", true},
      {statics + cube +
           "[[assign]]\nblocks = [\"A\"]\norder = 1\ninside = { mesh = { file = \"none.obj\" } }\n",
       "inside.mesh", true},
  };
  for (const auto& [text, key, with_a_shift] : refused) {
    EXPECT_TRUE(refusal(text, about_x()).starts_with(std::string(key) + " cannot be placed: ")) << key;
    EXPECT_EQ(refusal(text, shift).empty(), !with_a_shift) << key;
    EXPECT_EQ(refusal(text, {}), "") << key;
  }
  // About z heights along it and horizontal rows stay.
  EXPECT_EQ(refusal(weightless + drift, about_z()), "");
}

/// Until motion begins a side along an axis slides along the boundary, any other one is held.
TEST(ScenePlacement, SidesOfTheModelAreHeldAlongAxes) {
  const std::string text =
      statics + cube + "[[boundary]]\nkind = \"quiet\"\nplane = { point = [0, 0, 0], normal = ";
  ScenePlacement little;
  little.turn = Eigen::AngleAxisd(0.1, Vector3::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(refusal(text + "[-1, 0, 0] }\n", little).starts_with("boundary.plane cannot be placed"));
  EXPECT_EQ(refusal(text + "[-1, 0, 0] }\n", about_z()), "");
  EXPECT_EQ(refusal(text + "[0, 0, -1] }\n", little), "");
}

TEST(ScenePlacement, HeightsHaveOneDirectionInAllStages) {
  const std::string text =
      statics + cube +
      "[[measure]]\nname = \"d\"\ndrift = { blocks = [\"A\"], heights = [1, 5] }\n"
      "[[stage]]\nname = \"one\"\n[[stage]]\nname = \"two\"\nanalysis = { gravity = [1, 0, -9] }\n";
  EXPECT_TRUE(refusal(text, about_z()).starts_with("measure.drift.heights cannot be placed: stages"));
}

}  // namespace
}  // namespace ashlar::scene_placement_refusal_test

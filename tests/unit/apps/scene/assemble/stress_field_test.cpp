#include "apps/scene/assemble/stress_field.hpp"

#include <gtest/gtest.h>

#include <string>

#include "apps/scene/assemble/build_simulation.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::stress_field_test {
namespace {

/// A cube of 2 m on a floor. @param more lines after its block
std::string cube_on_floor(const std::string& initial_stress, const std::string& more = "") {
  return R"([analysis]
type = "static"
[contact]
friction_angle = 30
[[material]]
name = "rock"
density = 2500
young_modulus = 1e9
poisson_ratio = 0.25
)" + initial_stress +
         R"([[block]]
name = "floor"
box = { min = [-9, -9, -1], max = [9, 9, 0] }
fixed = true
[[block]]
name = "cube"
material = "rock"
order = 2
box = { min = [0, 0, 0], max = [2, 2, 2] }
)" + more;
}

Scene scene_of(const std::string& text) {
  Diagnostics faults;
  const auto loaded = load_scene_text(text, "s.toml", {}, faults);
  EXPECT_TRUE(loaded) << (faults.sorted().empty() ? "" : faults.sorted().front().message);
  return loaded ? Scene(loaded->scene) : Scene{};
}

TEST(StressField, K0IsTheWeightAbove) {
  const Scene scene =
      scene_of(cube_on_floor("[initial_stress]\nk0 = 0.5\nsurface = 3\nunit_weight = 1000\n"));
  const StressField stress = initial_stress_of(scene, 1, 0);
  ASSERT_TRUE(stress);
  EXPECT_EQ(stress({0, 0, 1}), Eigen::Vector3d(-1000, -1000, -2000).asDiagonal().toDenseMatrix());
  EXPECT_TRUE(stress({0, 0, 4}).isZero(0.0));
}

TEST(StressField, ComponentsMayBeFormulasOfThePlace) {
  const Scene scene =
      scene_of(cube_on_floor("[parameters]\ng = 2\n[initial_stress]\nstress = [\"= -g * x\", 1, \"= y + z\", "
                             "4, 5, 6]\nblocks = [\"cube\"]\n"));
  const StressField stress = initial_stress_of(scene, 1, 0);
  ASSERT_TRUE(stress);
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << -6, 4, 6, 4, 1, 5, 6, 5, 9).finished();
  EXPECT_EQ(stress({3, 4, 5}), expected);
  EXPECT_FALSE(initial_stress_of(scene, 0, 0));
}

// A block that is taken away and put back was in the ground until then.
TEST(StressField, BlocksHaveNoneOnceTheyAreAdded) {
  const Scene scene = scene_of(cube_on_floor("[initial_stress]\nk0 = 1\nsurface = 2\n",
                                             "[[stage]]\nname = \"one\"\n"
                                             "[[stage]]\nname = \"two\"\nremove = [\"cube\"]\n"
                                             "[[stage]]\nname = \"three\"\nadd = [\"cube\"]\n"));
  EXPECT_TRUE(initial_stress_of(scene, 1, 0));
  EXPECT_TRUE(initial_stress_of(scene, 1, 1));
  EXPECT_FALSE(initial_stress_of(scene, 1, 2));
}

/// First warning of a simulation that is built.
std::string warning_of(const std::string& text) {
  Diagnostics faults;
  const auto loaded = load_scene_text(text, "s.toml", {}, faults);
  if (!loaded || !build_simulation(*loaded, 1, faults)) return "not built";
  return faults.sorted().empty() ? "" : faults.sorted().front().message;
}

// Stress on the floor is that of the weight if the surface is the cube's top, twice as much if it is 2 m above.
TEST(StressField, AWeightThatIsNotThereIsReported) {
  EXPECT_EQ(warning_of(cube_on_floor("[initial_stress]\nk0 = 0\nsurface = 2\n")), "");
  const std::string warning = warning_of(cube_on_floor("[initial_stress]\nk0 = 0\nsurface = 4\n"));
  // 8 m^3 of weight, 16 m^3 of stress: 1/3 of the sum of both, 8 * 2500 * 9.81 N.
  EXPECT_TRUE(warning.starts_with(
      "initial stress is not in balance with weight, loads and boundaries: block \"cube\" "
      "lacks 1.96e+05 N (33.3 % of the forces on it)"))
      << warning;
}

// An excavation leaves blocks without support: that is no fault of the stress.
TEST(StressField, LaterStagesBeginFromTheOneBefore) {
  Diagnostics faults;
  const auto loaded = load_scene_text(cube_on_floor("[initial_stress]\nk0 = 0\nsurface = 4\n",
                                                    "[[stage]]\nname = \"one\"\n[[stage]]\nname = \"two\"\n"),
                                      "s.toml", {}, faults);
  ASSERT_TRUE(loaded);
  ASSERT_TRUE(build_simulation(stage_of(*loaded, 1), 1, faults));
  EXPECT_TRUE(faults.sorted().empty());
  ASSERT_TRUE(build_simulation(stage_of(*loaded, 0), 1, faults));
  EXPECT_FALSE(faults.sorted().empty());
}

// The root of a negative number on the floor, z = 0, but nowhere at a point of integration inside the cube.
TEST(StressField, AFormulaWithoutAValueOnAJointIsAFault) {
  Diagnostics faults;
  const auto loaded =
      load_scene_text(cube_on_floor("[initial_stress]\nstress = [0, 0, \"= sqrt(z - 1e-6)\", 0, 0, 0]\n"),
                      "s.toml", {}, faults);
  ASSERT_TRUE(loaded);
  EXPECT_FALSE(build_simulation(*loaded, 1, faults));
  EXPECT_FALSE(faults.good());
}

}  // namespace
}  // namespace ashlar::test::stress_field_test

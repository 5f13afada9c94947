#include "apps/scene/survey_fit.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/scene/scene_loading.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two bricks that overlap by a tenth of a millimetre, the upper one's corners a little off.
std::string surveyed(const std::string& fit) {
  return fmt::format(R"(analysis = {{ type = "static" }}
contact = {{ {} }}
[[block]]
name = "lower"
fixed = true
box = {{ min = [0, 0, 0], max = [1, 1, 1] }}
[[block]]
name = "upper"
fixed = false
material = "stone"
translate = [0, 0, 1]
hull = {{ points = [[0, 0, -1e-4], [1, 0, 5e-5], [0, 1, 5e-5], [1, 1, -1e-4],
                    [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]] }}
[[material]]
name = "stone"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
)",
                     fit);
}

std::vector<std::string> load(const std::string& fit, std::optional<LoadedScene>& loaded) {
  const TemporaryFolder folder;
  write_text(folder / "s.toml", surveyed(fit));
  Diagnostics diagnostics;
  loaded = load_scene(folder / "s.toml", {}, diagnostics);
  return printed(diagnostics);
}

TEST(SurveyFit, MakesNeighboursTouch) {
  std::optional<LoadedScene> loaded;
  EXPECT_THAT(load("friction_angle = 30", loaded), ElementsAre(HasSubstr("overlap by")));
  EXPECT_THAT(load("friction_angle = 30, fit = 3e-4", loaded), IsEmpty());
  ASSERT_TRUE(loaded);
  EXPECT_THAT(loaded->scene.notes, ElementsAre(HasSubstr("moved by up to")));
  ASSERT_EQ(loaded->solids[1].faces().size(), 6U);
  // The plane of all eight corners is at 1 - 1.25e-5: their mean.
  for (const Vector3& point : loaded->solids[1].mesh().points)
    if (point.z() < 1.5) {
      EXPECT_NEAR(point.z(), 1.0 - 1.25e-5, 1e-15);
    }
  EXPECT_EQ(loaded->shapes[1]->mesh().points, loaded->solids[1].mesh().points);
}

TEST(SurveyFit, IsRefusedWhereItIsTooLarge) {
  std::optional<LoadedScene> loaded;
  EXPECT_THAT(load("friction_angle = 30, fit = 2", loaded),
              Contains(HasSubstr("s.toml:2:40: error: blocks cannot be fitted: ")));
}

}  // namespace
}  // namespace ashlar::test

// Every scene of data/scenes can be read, built and stepped.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::demo_scenes_test {
namespace {

std::vector<std::filesystem::path> scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(ASHLAR_DATA_DIR) / "scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class DemoScene : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(DemoScene, TakesItsFirstSteps) {
  Diagnostics diagnostics;
  const auto loaded = load_scene(GetParam(), {}, diagnostics);
  std::ostringstream text;
  diagnostics.print(text);
  ASSERT_TRUE(loaded) << text.str();
  EXPECT_FALSE(loaded->scene.title.empty());
  auto built = build_simulation(*loaded, 1, diagnostics);
  diagnostics.print(text);
  ASSERT_TRUE(built) << text.str();
  EXPECT_EQ(text.str(), "");
  Simulation& simulation = built->simulation;
  const double end_time = loaded->scene.analysis.end_time;
  for (int k = 0; k < 5; ++k) {
    if (loaded->scene.analysis.type == SceneAnalysis::Type::statics) {
      EXPECT_NE(simulation.static_step(end_time), StaticStatus::not_converged);
    } else {
      ASSERT_EQ(simulation.step(end_time), StepStatus::accepted);
    }
  }
}

TEST_P(DemoScene, HasItsPicture) {
  const std::string name = GetParam().stem().string();
  const std::filesystem::path pictures = std::filesystem::path(ASHLAR_DATA_DIR) / "pictures";
  const std::string file = name + (name == "falling_block" ? "_0950.png" : ".png");
  ASSERT_TRUE(std::filesystem::exists(pictures / file)) << "data/make_pictures.sh draws it";
  // 1280 x 840 pixels.
  EXPECT_LT(std::filesystem::file_size(pictures / file), 300'000U);
  EXPECT_NE(read_text(GetParam()).find("data/pictures/" + name), std::string::npos);
  EXPECT_NE(
      read_text(std::filesystem::path(ASHLAR_DATA_DIR) / "../apps/docs/gallery.md").find("pictures/" + file),
      std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, DemoScene, ::testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param.stem().string(); });

}  // namespace
}  // namespace ashlar::demo_scenes_test

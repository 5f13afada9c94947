// A crack that appears in a stage stays in the next ones, with the traction that its joint had.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "apps/run/run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar::cracked_stages_test {
namespace {

// The bar of bar.toml: f_t = 3 MPa, G = 100 N/m, E/L = 1e11 Pa/m, so that u0 = 30 um and wf = 66.7 um. It is pulled to
// 1.4 u0 in the first stage, where its tension has fallen to f_t (wf - 1.4 u0)/(wf - u0), and rests in the second one.
constexpr double strength = 3e6, elongation = 3e-5, widest = 2.0 * 100.0 / strength;

double tension_at(double pulled) {
  return strength * (widest - pulled * elongation) / (widest - elongation);
}

double tension_of(const Run& run) {
  return run.motion("bar.crack1.a", Vector3(0.0, 0.05, 0.05)).stress(0, 0);
}

void expect_the_same_tension(const std::vector<std::string>& overrides) {
  std::vector<std::string> all = {
      "stage=[{ name = \"first\", analysis = { end_time = 1.4 } }, { name = \"second\", analysis = { "
      "end_time = 0.4 } }]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Diagnostics diagnostics;
  auto scene =
      load_scene(std::filesystem::path(ASHLAR_DATA_DIR) / "verification/cracks/bar.toml", all, diagnostics);
  ASSERT_TRUE(scene.has_value()) << (diagnostics.good() ? "" : diagnostics.sorted().front().message);
  Run run(std::move(*scene));
  while (run.step() && !run.stage_follows()) {
  }
  ASSERT_EQ(run.stage(), 1);
  const double before = tension_of(run);
  EXPECT_NEAR(before, tension_at(1.4), 0.01 * strength);
  while (run.step()) {
  }
  ASSERT_EQ(run.stage(), 2);
  EXPECT_NEAR(tension_of(run), before, 1e-3 * strength);
  EXPECT_EQ(run.simulation().blocks().size(), 2U);
  ASSERT_EQ(run.cracks().events.size(), 1U);
  EXPECT_EQ(run.cracks().events[0].stage, 0);
  EXPECT_NEAR(run.cracks().events[0].time, 1.0, 0.011);
}

TEST(CrackedStages, InStatics) {
  expect_the_same_tension({});
}

TEST(CrackedStages, InMotion) {
  expect_the_same_tension({"analysis.type=\"dynamic\""});
}

}  // namespace
}  // namespace ashlar::cracked_stages_test

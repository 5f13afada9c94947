#include "apps/results/columns/summary_units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/run/run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar::summary_units_test {
namespace {

TEST(SummaryUnits, PathsOfListsAreThoseOfTheirEntries) {
  const nlohmann::ordered_json summary = {
      {"time", 2.0},
      {"steps", 7},
      {"deepest", {{"value", 0.1}, {"place", {1, 2, 3}}}},
      {"moving",
       {{{"block", "a"}, {"acceleration", {0, 0, 1}}}, {{"block", "b"}, {"acceleration", {0, 0, 1}}}}},
      {"load_factor", {{"lower", 1.0}, {"limit", {{"displacement", 0.1}}}}},
      {"scene", {{"time", 3.0}}}};
  EXPECT_EQ(summary_units(summary), nlohmann::ordered_json({{"time", "s"},
                                                            {"deepest.value", "m"},
                                                            {"deepest.place", "m"},
                                                            {"moving.acceleration", "m/s^2"},
                                                            {"load_factor.limit.displacement", "m"}}));
  EXPECT_THAT(undeclared_numbers({{"length", 1.0}, {"list", {{{"size", 2}}}}}),
              testing::ElementsAre("length", "list.size"));
}

/// Scenes of verification cases with all parts of a summary.
class EverySummary : public testing::TestWithParam<const char*> {};

TEST_P(EverySummary, HasAUnitForEachNumber) {
  const std::filesystem::path file = std::filesystem::path(ASHLAR_DATA_DIR) / "verification" / GetParam();
  Diagnostics faults;
  auto loaded = load_scene(file, {}, faults);
  std::ostringstream text;
  faults.print(text);
  ASSERT_TRUE(loaded) << text.str();
  ashlar::Run run(std::move(*loaded));
  while (run.step()) {
  }
  const auto summary = nlohmann::ordered_json::parse(run.summary());
  EXPECT_THAT(undeclared_numbers(summary), testing::IsEmpty());
  EXPECT_TRUE(summary["units"].is_object());
  EXPECT_EQ(summary["units"]["wall_seconds.total"], "s");
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySummary,
                         testing::Values("limits/plane.toml", "limits/flat_arch.toml", "pushover/block.toml",
                                         "slopes/incline.toml", "bolts/slope.toml", "bolts/struts.toml",
                                         "restitution/landing.toml", "ground/tension_crack.toml",
                                         "joints/dilation_load.toml", "one_block/cantilever.toml",
                                         "bonds/tie.toml", "accuracy/swelling.toml",
                                         "accuracy/tumbling.toml"));

}  // namespace
}  // namespace ashlar::summary_units_test

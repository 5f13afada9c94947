// Scenes with [[crack]] that are refused, by the name of what stands in the way.
#include "apps/scene/assemble/cracking_blocks.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/run/run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar::cracking_blocks_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The fault of a bar that is pulled apart, with other values of some keys; empty: there is none.
std::string fault_with(const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  auto loaded = load_scene(std::filesystem::path(ASHLAR_DATA_DIR) / "verification/cracks/bar.toml", overrides,
                           diagnostics);
  if (!loaded) return diagnostics.sorted().front().message;
  try {
    const Run run(std::move(*loaded));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(CrackingBlocks, ABarThatCanCrackHasNoFault) {
  EXPECT_EQ(fault_with({}), "");
}

TEST(CrackingBlocks, BlocksThatCannotCrackAreRefusedByName) {
  EXPECT_THAT(fault_with({"block.bar.order=0", "block.bar.fix=[]", "analysis.type=\"dynamic\""}),
              AllOf(HasSubstr("block \"bar\" is rigid"), HasSubstr("order 1")));
  EXPECT_THAT(
      fault_with(
          {"block.bar={ name = \"bar\", fixed = true, box = { min = [0, 0, 0], max = [0.3, 0.1, 0.1] } }"}),
      HasSubstr("block \"bar\" is fixed"));
  EXPECT_THAT(fault_with({"crack.0.blocks=[\"beam\"]"}), HasSubstr("crack names no block (\"beam\")"));
}

TEST(CrackingBlocks, ABlockHasRoomForTwoParts) {
  EXPECT_EQ(fault_with({"crack.0.least_size=0.15"}), "");
  EXPECT_THAT(fault_with({"crack.0.least_size=0.1501"}),
              AllOf(HasSubstr("least_size is too large for block \"bar\""), HasSubstr("0.3 m")));
}

TEST(CrackingBlocks, KeysThatDoNotGoWithCracksAreRefused) {
  EXPECT_THAT(fault_with({"analysis.type=\"factor-of-safety\""}), HasSubstr("beside [[crack]]"));
  EXPECT_THAT(fault_with({"analysis.formulation=\"incremental\"", "analysis.type=\"dynamic\"", "measure=[]"}),
              HasSubstr("beside [[crack]]"));
  EXPECT_THAT(fault_with({"contact.springs=\"point\""}), HasSubstr("beside [[crack]]"));
}

TEST(CrackingBlocks, AStrengthNeedsItsEnergy) {
  EXPECT_THAT(
      fault_with(
          {"crack=[{ blocks = [\"bar\"], tensile_strength = 3e6, least_size = 0.05, friction_angle = 30, "
           "cohesion = 6e6 }]"}),
      HasSubstr("fracture_energy"));
}

// The run ends at the step that would make one part too many, with the state before it.
TEST(CrackingBlocks, MorePartsThanAllowedEndTheRun) {
  Diagnostics diagnostics;
  auto loaded = load_scene(std::filesystem::path(ASHLAR_DATA_DIR) / "verification/cracks/bar.toml",
                           {"crack.0.most_blocks=1"}, diagnostics);
  ASSERT_TRUE(loaded.has_value());
  ashlar::Run run(std::move(*loaded));
  std::string reason;
  try {
    while (run.step()) {
    }
  } catch (const std::runtime_error& error) {
    reason = error.what();
  }
  EXPECT_EQ(run.status(), RunStatus::failed);
  EXPECT_THAT(reason, AllOf(HasSubstr("block \"bar\" cracks"), HasSubstr("more than 1 blocks")));
  EXPECT_EQ(run.simulation().blocks().size(), 1U);
  EXPECT_TRUE(run.cracks().events.empty());
}

}  // namespace
}  // namespace ashlar::cracking_blocks_test

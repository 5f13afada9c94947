#include "apps/scene/read/block_arrays.hpp"

#include <gmock/gmock.h>

#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::block_arrays_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(BlockArrays, LayBlocksOutTheFirstDirectionFastest) {
  Diagnostics diagnostics;
  const Scene scene = parse_scene(
      sample_with(
          20,
          "box = { min = [0, 0, 0], max = [4, 1, 1] }\n"
          "array = { count = [2, 1, 3], step = [[5, 0, 0], [0, 7, 0], [0, 0, 2]], stagger = [0.5, 0, 0] "
          "}"),
      "s.toml", {"measure.tip.block=B.2", "joint.0.blocks=[\"A\", \"B.*\"]"}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  ASSERT_THAT(scene.block, SizeIs(7));
  const std::vector<Vector3> ways = {{0, 0, 0}, {5, 0, 0}, {0.5, 0, 2}, {5.5, 0, 2}, {0, 0, 4}, {5, 0, 4}};
  for (std::size_t k = 0; k < 6; ++k) {
    const SceneBlock& block = scene.block[k + 1];
    EXPECT_EQ(block.name, "B." + std::to_string(k + 1));
    EXPECT_EQ(block.translate, ways[k]) << k;
    EXPECT_EQ(std::get<ScenePlane>(block.fix[0].where).point, ways[k]);
    EXPECT_EQ(std::get<ScenePlane>(block.load[0].where).point, ways[k] + Vector3(4, 0, 0));
    EXPECT_FALSE(block.array);
    EXPECT_EQ(to_string(scene.places.key("block." + std::to_string(k + 1) + ".order")), "s.toml:17:1");
    EXPECT_EQ(to_string(scene.places.value("block." + std::to_string(k + 1) + ".name")), "s.toml:18:8");
  }
  EXPECT_EQ(to_string(scene.places.value("block.0.name")), "s.toml:14:8");
}

class BadArray : public ::testing::TestWithParam<FaultCase> {};

TEST_P(BadArray, IsRefused) {
  const auto& [line, replacement, expected] = GetParam();
  EXPECT_THAT(reading_faults(sample_with(line, sample_lines[19] + "\n" + replacement)),
              ElementsAre(StartsWith(expected)));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadArray,
    ::testing::Values(
        FaultCase{20, "array = { count = [2, 2], step = [[1, 0, 0]] }",
                  "s.toml:21:34: error: step has the wrong length (1 entries), one for each of the 2 counts"},
        FaultCase{
            20, "array = { count = [], step = [[1, 0, 0]] }",
            "s.toml:21:19: error: count has the wrong length (0 entries), 1 to 3 directions are needed"},
        FaultCase{20, "array = { count = [0], step = [[1, 0, 0]] }",
                  "s.toml:21:20: error: count is out of range (0), a whole number from 1 to 20000 is needed"},
        FaultCase{20, "array = { count = [20000, 20000, 20000], step = [[1, 0, 0], [1, 0, 0], [1, 0, 0]] }",
                  "s.toml:21:19: error: array is too large (8e+12 blocks), at most 20000 are allowed"},
        FaultCase{20,
                  "array = { count = [15000], step = [[9, 0, 0]] }\n[[block]]\nname = \"C\"\n"
                  "box = { min = [0, 9, 0], max = [1, 10, 1] }\n"
                  "array = { count = [15000], step = [[9, 0, 0]] }",
                  "s.toml:17:1: error: scene has too many blocks (30001 or more, 15000 of them here), at "
                  "most 20000"},
        FaultCase{20, "array = { step = [[1, 0, 0]] }", "s.toml:21:1: error: missing key (count)"}));

}  // namespace
}  // namespace ashlar::test::block_arrays_test

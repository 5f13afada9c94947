// The cost of scenes is estimated, and refused, before they are built: none of these could be built within a
// test.
#include "apps/scene/check/cost_estimate.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "apps/scene/expand/scene_solids.hpp"
#include "unit/apps/run_fixture.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::cost_estimate_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string head = R"(analysis = { end_time = 0.002, time_step = 1e-3 }
material = [{ name = "m", density = 2700, young_modulus = 1e9, poisson_ratio = 0.2 }]
contact = { subdivisions = 4, friction_angle = 30 }
)";

std::string sphere(int order, int subdivisions) {
  return fmt::format(
      "[[block]]\nname = \"ball\"\nmaterial = \"m\"\norder = {}\nsphere = {{ radius = 1, subdivisions = {} "
      "}}\n",
      order, subdivisions);
}

Scene scene_of(const std::string& text) {
  Diagnostics diagnostics;
  Scene scene = parse_scene(text, "s.toml", {}, diagnostics);
  EXPECT_TRUE(diagnostics.good());
  return scene;
}

TEST(CostEstimate, CountsWhatIsDivided) {
  const CostEstimate bent = estimate_cost(scene_of(head + sphere(2, 5)));
  EXPECT_EQ(bent.triangles, 20480.0);
  EXPECT_EQ(bent.sub_faces, 20480.0 * 256.0);
  EXPECT_EQ(bent.unknowns, 30.0);
  // Blocks of order 1 stay flat.
  EXPECT_EQ(estimate_cost(scene_of(head + sphere(1, 5))).sub_faces, 20480.0);
  EXPECT_EQ(estimate_cost(scene_of(sample())).unknowns, 24.0);
  EXPECT_EQ(estimate_cost(scene_of(head + sphere(0, 5))).unknowns, 6.0);
}

/// 27 unit cubes that fill a cube.
std::string filled_cube() {
  std::string text = head;
  for (int k = 0; k < 27; ++k) {
    const int x = k % 3, y = k / 3 % 3, z = k / 9;
    text += fmt::format(
        "[[block]]\nname = \"b{}\"\nmaterial = \"m\"\nbox = {{ min = [{}, {}, {}], max = [{}, {}, {}] }}\n",
        k, x, y, z, x + 1, y + 1, z + 1);
  }
  return text;
}

// 54 pairs share a face, 72 an edge, 32 a corner: 158 in all. Half of the faces are 81, and a pair has 24 unknowns.
TEST(CostEstimate, NoMorePairsTakeMemoryThanFacesCanTouch) {
  Diagnostics diagnostics;
  const Scene scene = scene_of(filled_cube());
  const std::vector<std::optional<Polyhedron>> solids = build_solids(scene, diagnostics);
  const CostEstimate estimate = estimate_cost(scene, &solids);
  EXPECT_EQ(estimate.pairs, 158.0);
  EXPECT_NEAR(estimate.memory - estimate_cost(scene).memory, 81.0 * 24.0 * 1e4, 1.0);
}

// 27 cubes with 12 unknowns, of one kind: 12 triangles of 2 kB and two matrices of 12 x 12 numbers each, four matrices of
// the kind, and 81 pairs with 24 unknowns of 10 kB; beside 20 MB of the program.
TEST(CostEstimate, ARankHasAPartOfTheBlocksAndTheWholeScene) {
  Diagnostics diagnostics;
  const Scene scene = scene_of(filled_cube());
  const std::vector<std::optional<Polyhedron>> solids = build_solids(scene, diagnostics);
  const double blocks = 27.0 * 12.0 * 2000.0 + 81.0 * 24.0 * 1e4 + (27.0 * 2.0 + 4.0) * 8.0 * 144.0;
  EXPECT_NEAR(estimate_cost(scene, &solids).memory, 2e7 + blocks, 1.0);
  // A rank has a quarter more than its mean part, and 40 kB of each block.
  const CostEstimate estimate = estimate_cost(scene, &solids, 4);
  EXPECT_NEAR(estimate.memory, 2e7 + 27.0 * 4e4 + 1.25 * blocks / 4.0, 1.0);
  EXPECT_EQ(estimate.unknowns, 27.0 * 12.0);
  EXPECT_THAT(to_string(estimate, 27), HasSubstr(", 158 pairs of near blocks, 27 MB on each of 4 ranks"));
  // Blocks that are cheaper than what all ranks have of them.
  const Scene small = scene_of(sample());
  EXPECT_EQ(estimate_cost(small, nullptr, 2).memory, estimate_cost(small).memory);
}

TEST(CostEstimate, TheLimitIsThatOfARank) {
  Diagnostics diagnostics;
  std::string text = filled_cube();
  text.replace(text.find("1e-3 }"), 6, "1e-3, memory_limit = 3e7 }");
  const Scene scene = scene_of(text);
  const std::vector<std::optional<Polyhedron>> solids = build_solids(scene, diagnostics);
  EXPECT_FALSE(check_cost(scene, estimate_cost(scene, &solids), diagnostics));
  EXPECT_TRUE(check_cost(scene, estimate_cost(scene, &solids, 4), diagnostics));
}

TEST_F(RunCommand, AScene270BytesLongIsRefusedForItsSize) {
  write_text(scene_, head + sphere(2, 5));
  EXPECT_EQ(command({"check", scene_.string()}), 2);
  EXPECT_THAT(faults_,
              AllOf(HasSubstr("s.toml:4:1: error: scene is too large (estimate: 1 block, 5242880 sub-faces"),
                    HasSubstr("analysis.memory_limit")));
  EXPECT_EQ(run("out"), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  EXPECT_EQ(command({"check", scene_.string(), "--set", "contact.subdivisions=8", "--set",
                     "block.ball.sphere.subdivisions=7", "--set", "block.ball.order=12"}),
            2);
}

TEST_F(RunCommand, TheLimitIsAKeyOfTheScene) {
  write_text(scene_, head + sphere(2, 1));
  ASSERT_EQ(command({"check", scene_.string(), "--set", "contact.subdivisions=1"}), 0) << faults_;
  EXPECT_THAT(printed_,
              HasSubstr("\nestimate: 1 block, 320 sub-faces, 30 unknowns, 0 pairs of near blocks, "));
  EXPECT_EQ(command({"check", scene_.string(), "--set", "analysis.memory_limit=1e7"}), 2);
  EXPECT_THAT(faults_, HasSubstr("scene is too large"));
  EXPECT_EQ(command({"check", scene_.string(), "--set", "analysis.memory_limit=1e12"}), 0) << faults_;
}

TEST_F(RunCommand, BlocksInOnePlaceAreCountedNotListed) {
  std::string text = head;
  for (int k = 0; k < 500; ++k)
    text += fmt::format(
        "[[block]]\nname = \"b{}\"\nmaterial = \"m\"\nbox = {{ min = [0, 0, 0], max = [1, 1, {}] }}\n", k,
        1.0 + 0.001 * k);
  write_text(scene_, text);
  EXPECT_EQ(command({"check", scene_.string()}), 2);
  EXPECT_LT(faults_.size(), 10'000U);
  EXPECT_THAT(
      faults_,
      HasSubstr("20 pairs of blocks overlap, 124730 more pairs with boxes that meet were not looked at"));
}

TEST_F(RunCommand, ManyJointsOfManyBlocksAreChecked) {
  std::string text = head;
  for (int k = 0; k < 1000; ++k)
    text += fmt::format("[[joint]]\nblocks = [\"*\", \"b{}\"]\nfriction_angle = 3\n", k);
  for (int k = 0; k < 1000; ++k)
    text += fmt::format(
        "[[block]]\nname = \"b{0}\"\nmaterial = \"m\"\nbox = {{ min = [{1}, 0, 0], max = [{2}, 1, 1] }}\n", k,
        2 * k, 2 * k + 1);
  write_text(scene_, text);
  EXPECT_EQ(command({"check", scene_.string()}), 0) << faults_;
}

TEST_F(RunCommand, AHundredThousandUnknownKeysAreCounted) {
  std::string text = head;
  for (int k = 0; k < 100'000; ++k) text += fmt::format("k{} = 0\n", k);
  write_text(scene_, text + sphere(1, 1));
  EXPECT_EQ(command({"check", scene_.string()}), 2);
  EXPECT_LT(faults_.size(), 20'000U);
  EXPECT_THAT(faults_, HasSubstr(" more of this kind from here on (unknown key"));
}

}  // namespace
}  // namespace ashlar::test::cost_estimate_test

#include "apps/scene/assemble/block_survey.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <mutex>
#include <set>

#include "apps/scene/assemble/build_simulation.hpp"
#include "geometry/index.hpp"
#include "solver/ranks/thread_ranks.hpp"
#include "solver/shared/gathered_run.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::block_survey_test {
namespace {

using test::printed;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* head = R"(
analysis = { end_time = 1, time_step = 0.01 }
contact = { friction_angle = 30 }
material = [{ name = "rock", density = 2500, young_modulus = 1e9, poisson_ratio = 0.25 }]
)";

/// A ground, a block of each kind, and bricks beside each other that are equal.
std::string blocks_of_all_kinds(int bricks) {
  std::string text = std::string(head) + R"(
masonry = [{ name = "wall", kind = "wall", material = "rock", length = )" +
                     std::to_string(bricks) + R"(, height = 1, brick = [1, 1, 1] }]
block = [{ name = "ground", fixed = true, box = { min = [-1, -1, -1], max = [40, 2, 0] } },
         { name = "stiff", material = "rock", order = 0, box = { min = [0, 3, 0], max = [2, 4, 4] } },
         { name = "bent", material = "rock", order = 2, box = { min = [0, 5, 0], max = [3, 8, 3] } }]
)";
  return text;
}

LoadedScene loaded_scene(const TemporaryFolder& folder, const std::string& text) {
  write_text(folder / "s.toml", text);
  Diagnostics diagnostics;
  std::optional<LoadedScene> loaded = load_scene(folder / "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), Each(HasSubstr("warning")));
  return std::move(loaded.value());
}

/// Calls survey(ranks, survey, faults) on each of some ranks; with 0 once, without ranks.
void survey_on(
    int count, const LoadedScene& loaded,
    const std::function<void(const RunRanks*, std::optional<BlockSurvey>&, const Diagnostics&)>& use) {
  const auto survey = [&](const RunRanks* ranks) {
    Diagnostics diagnostics;
    const SceneModels models(loaded, SimulationSettings(), 1.0, diagnostics);
    std::optional<BlockSurvey> result = survey_blocks(models, ranks, diagnostics);
    use(ranks, result, diagnostics);
  };
  if (count == 0) return survey(nullptr);
  run_on_threads(count, [&](Ranks& ranks) {
    const RunRanks shared{ranks};
    survey(&shared);
  });
}

TEST(BlockSurvey, HasTheNumbersOfEachBlock) {
  const TemporaryFolder folder;
  const LoadedScene loaded = loaded_scene(folder, blocks_of_all_kinds(2));
  survey_on(0, loaded, [](const RunRanks*, std::optional<BlockSurvey>& survey, const Diagnostics&) {
    ASSERT_TRUE(survey);
    ASSERT_EQ(survey->models.size(), 5u);
    const BlockSummary& stiff = survey->blocks.at(1);
    EXPECT_EQ(stiff.box.low, Vector3(0, 3, 0));
    EXPECT_EQ(stiff.box.high, Vector3(2, 4, 4));
    EXPECT_LT((stiff.centroid - Vector3(1, 3.5, 2)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(stiff.stiffness.size, 2.0);  // of 8 m^3
    EXPECT_EQ(stiff.stiffness.young_modulus, 1e9);
    // A rigid block has 6 degrees of freedom; three components of 10 polynomials up to order 2, of 4 up to order 1.
    std::vector<std::array<int, 2>> kinds;
    for (const BlockSummary& block : survey->blocks) kinds.push_back({block.freedom, block.order});
    using Kind = std::array<int, 2>;
    EXPECT_THAT(kinds, ElementsAre(Kind{0, 1}, Kind{6, 1}, Kind{30, 2}, Kind{12, 1}, Kind{12, 1}));
    EXPECT_TRUE(survey->blocks.front().fixed());
    EXPECT_FALSE(stiff.fixed());
    // The bricks are equal.
    EXPECT_EQ(survey->different, 4u);
  });
}

TEST(BlockSurvey, IsTheSameOnAllRanksWithoutModels) {
  const TemporaryFolder folder;
  // More ranks than blocks, and as many as divide them into equal parts or not.
  const LoadedScene loaded = loaded_scene(folder, blocks_of_all_kinds(3));
  std::optional<BlockSurvey> alone;
  survey_on(0, loaded, [&](const RunRanks*, std::optional<BlockSurvey>& survey, const Diagnostics&) {
    alone = std::move(survey);
  });
  ASSERT_TRUE(alone);
  for (const int count : {1, 2, 3, 4, 7}) {
    std::mutex mutex;
    survey_on(count, loaded, [&](const RunRanks*, std::optional<BlockSurvey>& survey, const Diagnostics&) {
      const std::lock_guard lock(mutex);
      ASSERT_TRUE(survey);
      EXPECT_EQ(survey->models.size(), count == 1 ? 6u : 0u);
      EXPECT_EQ(survey->different, alone->different);
      ASSERT_EQ(survey->blocks.size(), alone->blocks.size());
      for (std::size_t k = 0; k < alone->blocks.size(); ++k) {
        const BlockSummary &found = survey->blocks[k], &expected = alone->blocks[k];
        EXPECT_EQ(found.box.low, expected.box.low);
        EXPECT_EQ(found.box.high, expected.box.high);
        EXPECT_EQ(found.centroid, expected.centroid);
        EXPECT_TRUE(found.stiffness == expected.stiffness);
        EXPECT_EQ(found.freedom, expected.freedom);
        EXPECT_EQ(found.order, expected.order);
      }
    });
  }
}

/// Faults as printed, of each rank; with 0 those without ranks.
std::vector<std::vector<std::string>> faults_on(int count, const LoadedScene& loaded) {
  std::vector<std::vector<std::string>> faults(std::max<std::size_t>(at(count), 1));
  survey_on(count, loaded,
            [&](const RunRanks* ranks, std::optional<BlockSurvey>& survey, const Diagnostics& found) {
              faults[ranks == nullptr ? 0 : at(ranks->ranks.own())] = printed(found);
              EXPECT_EQ(survey.has_value(), found.good());
            });
  return faults;
}

TEST(BlockSurvey, FaultsOfBlocksAreToldOnAllRanks) {
  const TemporaryFolder folder;
  // An angle of two legs, 1 m long and 10 micrometres wide.
  write_text(folder / "ell.off",
             "OFF\n12 8 0\n0 0 0\n1 0 0\n1 1e-5 0\n1e-5 1e-5 0\n1e-5 1 0\n0 1 0\n0 0 1e-5\n1 0 1e-5\n"
             "1 1e-5 1e-5\n1e-5 1e-5 1e-5\n1e-5 1 1e-5\n0 1 1e-5\n6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n"
             "4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n");
  std::string text = std::string(head) + "block = [\n";
  for (int k = 0; k < 5; ++k)
    text += fmt::format("{{ name = \"b{0}\", material = \"rock\", {1}, translate = [{2}, 0, 0] }},\n", k,
                        k == 2 || k == 4 ? "order = 4, mesh = { file = \"ell.off\" }"
                                         : "order = 1, box = { min = [0, 0, 0], max = [1, 1, 1] }",
                        2 * k);
  const LoadedScene loaded = loaded_scene(folder, text + "]\n");
  const std::vector<std::string> alone = faults_on(0, loaded).front();
  EXPECT_THAT(alone, ElementsAre(HasSubstr(":8:"), HasSubstr(":10:")));
  EXPECT_THAT(alone, Each(HasSubstr("error: order is too high")));
  // Blocks 2 and 4 are those of ranks 2 and 1.
  EXPECT_THAT(faults_on(3, loaded), Each(alone));
}

TEST(BlockSurvey, WarningsOfBlocksAreToldOnAllRanks) {
  const TemporaryFolder folder;
  // A beam of 4 m whose far end goes up by 1 m: it turns by atan(1/8) (turned_supports_test.cpp).
  const LoadedScene loaded = loaded_scene(
      folder, test::sample_with(
                  22,
                  "plane = { point = [0, 0, 0], normal = [-1, 0, 0] }\n[[block.fix]]\nplane = { point = "
                  "[4, 0, 0], normal = [1, 0, 0] }\ndisplacement_history = [[0, 0, 0, 0], [1, 0, 0, 1]]"));
  const std::vector<std::string> alone = faults_on(0, loaded).front();
  EXPECT_THAT(alone, ElementsAre(HasSubstr("turns block \"B\" by 0.124 rad")));
  EXPECT_THAT(faults_on(3, loaded), Each(alone));
}

TEST(RunRanks, ARankLoadsItsBlocksAndThoseNearThemOnce) {
  const TemporaryFolder folder;
  const LoadedScene loaded = loaded_scene(folder, blocks_of_all_kinds(30));
  constexpr int count = 3;
  std::mutex mutex;
  survey_on(count, loaded,
            [&](const RunRanks* ranks, std::optional<BlockSurvey>& survey, const Diagnostics&) {
              ASSERT_TRUE(survey);
              const std::size_t blocks = survey->blocks.size();
              Diagnostics diagnostics;
              const SceneModels models(loaded, SimulationSettings(), 1.0, diagnostics);
              BlockPartsLibrary library;
              std::vector<int> made;
              SimulationSettings settings;
              settings.contact_distance = 1e-3;
              const Simulation simulation = simulation_of(ranks,
                                                          {std::move(survey->blocks),
                                                           {},
                                                           std::vector<InitialMotion>(blocks),
                                                           [](int, int) { return JointLaw(); },
                                                           settings,
                                                           {},
                                                           {}},
                                                          [&](int block) {
                                                            made.push_back(block);
                                                            return models.model(at(block), library);
                                                          });
              const RankWork work = work_of_ranks(simulation).at(at(ranks->ranks.own()));
              const std::lock_guard lock(mutex);
              EXPECT_EQ(std::set<int>(made.begin(), made.end()).size(), made.size());
              if (ranks->first()) return;
              EXPECT_EQ(static_cast<int>(made.size()), work.own + work.ghosts);
              EXPECT_LT(made.size(), blocks / 2);
            });
}

}  // namespace
}  // namespace ashlar::block_survey_test

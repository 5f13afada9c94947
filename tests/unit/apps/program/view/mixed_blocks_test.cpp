// Fixed, rigid and moved blocks in frames, in the summary and in the page of `ashlar view`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/program/command_line.hpp"
#include "apps/results/frames/vtu/vtu_reader.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::mixed_blocks_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// A base that histories move, a rigid stone on its way past it, a rigid stone at rest, a fixed one and one that an
// assignment fixes. Nothing touches.
constexpr const char* mixed_scene = R"([analysis]
end_time = 0.5
time_step = 0.125
gravity = [0, 0, 0]
[[material]]
name = "rock"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "base"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block.fix]]
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
velocity_history = [[0, 1, 0, 0]]
[[block.fix]]
plane = { point = [0, 0, 1], normal = [0, 0, 1] }
velocity_history = [[0, 1, 0, 0]]
[[block]]
name = "flying"
material = "rock"
order = 0
box = { min = [0, 0, 3], max = [1, 1, 4] }
velocity = [1, 0, 0]
[[block]]
name = "resting"
material = "rock"
order = 0
box = { min = [0, 0, 5], max = [1, 1, 6] }
[output]
every = 1
)";
constexpr const char* fixed_blocks = R"([[block]]
name = "wall"
fixed = true
box = { min = [0, 5, 0], max = [1, 6, 1] }
[[block]]
name = "assigned"
material = "rock"
order = 2
box = { min = [0, 8, 0], max = [1, 9, 1] }
[[assign]]
blocks = ["assigned"]
fixed = true
)";

struct MixedBlocks : ::testing::Test {
  TemporaryFolder folder;
  std::ostringstream out;
  std::ostringstream err;

  int run(std::vector<std::string> arguments) { return run_command_line(std::move(arguments), out, err); }
  nlohmann::json page_of(const std::string& scene, const std::vector<std::string>& more = {}) {
    write_text(folder / "mixed.toml", scene);
    EXPECT_EQ(run({"run", (folder / "mixed.toml").string(), "--out", (folder / "out").string(), "--quiet",
                   "--force"}),
              exit_status::done)
        << err.str();
    return view(more);
  }
  nlohmann::json view(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"view", (folder / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments), exit_status::done) << err.str();
    const std::string page = read_text(folder / "out/view.html");
    const std::string start = "<script id=\"scene\" type=\"application/json\">";
    const std::size_t begin = page.find(start) + start.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(read_text(folder / "out/summary.json"));
  }
};

TEST_F(MixedBlocks, FramesPageAndSummaryTellFixedFromRigidBlocks) {
  const auto page = page_of(std::string(mixed_scene) + fixed_blocks);
  EXPECT_EQ(page["fixed"], (nlohmann::json{3, 4}));
  EXPECT_EQ(summary()["fixed"], (nlohmann::json{"wall", "assigned"}));
  const UnstructuredGrid grid = read_vtu(folder / "out/frames/blocks_0000000.vtu");
  const auto values = [&](const std::string& name) {
    for (const DataArray& array : grid.cell_data)
      if (array.name == name) return std::get<std::vector<std::int32_t>>(array.values);
    return std::vector<std::int32_t>{};
  };
  const std::vector<std::int32_t> block = values("block"), order = values("order"), fixed = values("fixed");
  ASSERT_EQ(fixed.size(), block.size());
  for (std::size_t c = 0; c < block.size(); ++c) {
    EXPECT_EQ(fixed[c], block[c] >= 3 ? 1 : 0) << block[c];
    EXPECT_EQ(order[c], block[c] == 0 ? 1 : 0) << block[c];
  }
}

TEST_F(MixedBlocks, AFixedBlockThatAStageAddsIsFixed) {
  const auto page = page_of(std::string(mixed_scene) + fixed_blocks +
                            "[[stage]]\nname = \"first\"\n[[stage]]\nname = \"second\"\nadd = [\"wall\"]\n");
  const UnstructuredGrid first = read_vtu(folder / "out/frames/blocks_0000000.vtu");
  for (const DataArray& array : first.cell_data)
    if (array.name == "block") {
      EXPECT_THAT(std::get<1>(array.values), Not(Contains(3)));
    }
  EXPECT_EQ(page["fixed"], (nlohmann::json{3, 4}));
  EXPECT_EQ(page["blocks"][3]["name"], "wall");
}

TEST_F(MixedBlocks, OfFramesWithoutTheFieldBlocksThatNeverMoveAreFixed) {
  page_of(std::string(mixed_scene) + fixed_blocks);
  for (int step = 0; step <= 4; ++step) {
    const auto path = folder / ("out/frames/blocks_000000" + std::to_string(step) + ".vtu");
    UnstructuredGrid grid = read_vtu(path);
    std::erase_if(grid.cell_data, [](const DataArray& array) { return array.name == "fixed"; });
    write_vtu(path, grid);
  }
  // "resting" has nothing that moves it.
  EXPECT_EQ(view()["fixed"], (nlohmann::json{2, 3, 4}));
}

TEST_F(MixedBlocks, DisplacementsAreRelativeToTheBaseThatMoves) {
  EXPECT_EQ(page_of(mixed_scene)["relative_to"], 0);
  EXPECT_EQ(summary()["base"], "base");
  EXPECT_EQ(view({"--relative-to", "none"})["relative_to"], nullptr);
  EXPECT_EQ(view({"--relative-to", "resting"})["relative_to"], 2);
  EXPECT_EQ(view({"--relative-to", "1"})["relative_to"], 1);
  EXPECT_EQ(page_of(std::string(mixed_scene) + fixed_blocks)["relative_to"], nullptr) << "others are held";
  EXPECT_EQ(summary()["base"], nullptr);
}

TEST_F(MixedBlocks, NamesThatAreNoneAreRefusedWithTheNearest) {
  page_of(mixed_scene);
  ::setenv("ASHLAR_BROWSER", "/bin/false", 1);
  const std::string out_folder = (folder / "out").string();
  const std::string picture = (folder / "p.png").string();
  const std::vector<std::vector<std::string>> commands = {
      {"view", out_folder},
      {"picture", out_folder, "-o", picture},
      {"picture", out_folder, "-o", picture, "--frames", "0:1"}};
  for (std::vector<std::string> arguments : commands) {
    for (const auto& [wrong, near] :
         {std::pair("bsae", "base"), std::pair("restin", "resting"), std::pair("3", "")}) {
      std::vector<std::string> all = arguments;
      all.insert(all.end(), {"--relative-to", wrong});
      err.str("");
      EXPECT_EQ(run(all), exit_status::bad_input) << arguments.front();
      EXPECT_THAT(err.str(), HasSubstr("error: the run has no block \"" + std::string(wrong) + "\""));
      if (*near != '\0') {
        EXPECT_THAT(err.str(), HasSubstr("did you mean \"" + std::string(near) + "\"?"));
      }
    }
  }
  ::unsetenv("ASHLAR_BROWSER");
}

TEST_F(MixedBlocks, PiecesOfCutBlocksHaveTheirNamesAndMaterials) {
  const auto page = page_of(std::string(mixed_scene) +
                            "[[cut]]\nname = \"plane\"\nblocks = [\"resting\"]\ndip = 0\ndip_direction = 0\n"
                            "point = [0, 0, 5.5]\n");
  std::vector<std::string> names;
  for (const auto& block : page["blocks"]) {
    names.push_back(block["name"]);
    EXPECT_EQ(block["material"], "rock") << names.back();
  }
  EXPECT_THAT(names, ElementsAre("base", "flying", "resting.1", "resting.2"));
}

}  // namespace
}  // namespace ashlar::mixed_blocks_test

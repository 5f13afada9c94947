// `ashlar view` from its command line to its page; the page in a browser is tested in tests/browser.
#include "apps/program/view/view_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/program/view/view_file.hpp"
#include "apps/results/frames/vtu/vtu_reader.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/program/view/packed_reader.hpp"

namespace ashlar::view_command_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// A free cube that moves with (1, 0, 0) m/s and no weight: at t it has moved by t. Its name would end a
// script.
constexpr const char* scene_text = R"(title = "glide"
[analysis]
end_time = 0.5
time_step = 0.125
gravity = [0, 0, 0]
[contact]
normal_stiffness = 5e7
shear_stiffness = 5e7
friction_angle = 30
[[material]]
name = "rock"
density = 2000
young_modulus = 1e9
poisson_ratio = 0.2
[[block]]
name = "</script><b>"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
velocity = [1, 0, 0]
[output]
every = 1
)";

struct ViewCommand : ::testing::Test {
  TemporaryFolder folder;
  std::ostringstream out;
  std::ostringstream err;

  int run(std::vector<std::string> arguments) { return run_command_line(std::move(arguments), out, err); }
  void simulate(const std::vector<std::string>& more = {}) {
    write_text(folder / "glide.toml", scene_text);
    std::vector<std::string> arguments = {"run", (folder / "glide.toml").string(), "--out",
                                          (folder / "out").string(), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(run(arguments), exit_status::done) << err.str();
  }
  static std::string element(const std::string& page, const std::string& start) {
    const std::size_t begin = page.find(start) + start.size();
    return page.substr(begin, page.find("</script>", begin) - begin);
  }
  static std::string scene_of(const std::string& page) {
    return element(page, "<script id=\"scene\" type=\"application/json\">");
  }
  static std::vector<float> floats(const std::string& base64) {
    const std::string bytes = inflated(base64);
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  static PackedReader frame_of(const std::string& page, int frame) {
    std::istringstream lines(element(page, "<script id=\"frames\" type=\"text/plain\">\n"));
    std::string line;
    for (int k = 0; k <= frame; ++k) std::getline(lines, line);
    return PackedReader(inflated(line));
  }
};

TEST_F(ViewCommand, OfSolidsThePageHoldsTheSurfaces) {
  simulate();
  ASSERT_EQ(run({"view", (folder / "out").string()}), exit_status::done) << err.str();
  const std::string page = read_text(folder / "out/view.html");
  simulate({"--set", "output.solid=true", "--force"});
  for (const VtkCellType type : read_vtu(folder / "out/frames/blocks_0000004.vtu").types)
    EXPECT_EQ(type, VtkCellType::tetrahedron);
  ASSERT_EQ(run({"view", (folder / "out").string()}), exit_status::done) << err.str();
  const std::string frames = "<script id=\"frames\" type=\"text/plain\">\n";
  EXPECT_EQ(element(read_text(folder / "out/view.html"), frames), element(page, frames));
  simulate({"--force"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out/surfaces.pvd"));
}

TEST_F(ViewCommand, ThePageHoldsTheKeyBlocksOfTheFolder) {
  simulate();
  write_text(folder / "out/key_blocks.csv", "block,volume,factor_of_safety\n'=a,2.5,inf\n\"b,c\",1,0.5\n");
  ASSERT_EQ(run({"view", (folder / "out").string()}), exit_status::done) << err.str();
  const auto rows = nlohmann::json::parse(scene_of(read_text(folder / "out/view.html")))["key_blocks"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["block"], "=a");
  EXPECT_EQ(rows[0]["volume"], 2.5);
  EXPECT_TRUE(rows[0]["factor_of_safety"].is_null()) << "no limit";
  EXPECT_EQ(rows[1]["block"], "b,c");
  write_text(folder / "out/key_blocks.csv", "block,volume\na\n");
  EXPECT_NE(run({"view", (folder / "out").string()}), exit_status::done);
  EXPECT_THAT(err.str(), HasSubstr("line 2 has 1 fields, 2 are needed"));
}

TEST_F(ViewCommand, ThePageHoldsTheFrames) {
  simulate();
  ASSERT_EQ(run({"view", (folder / "out").string()}), exit_status::done) << err.str();
  EXPECT_THAT(out.str(), HasSubstr("(5 of 5 frames"));
  const std::string page = read_text(folder / "out" / "view.html");
  const auto scene = nlohmann::json::parse(scene_of(page));
  EXPECT_EQ(scene["points"], 8);
  EXPECT_EQ(scene["frames"][2]["time"], 0.25);
  EXPECT_EQ(scene["frames"][2]["step"], 2);
  EXPECT_EQ(scene["blocks"][0]["name"], "</script><b>");
  EXPECT_EQ(scene["analysis"], "dynamic");
  EXPECT_FALSE(scene["summary"].contains("scene"));
  EXPECT_EQ(floats(scene["reference"]).size(), 24U);
  PackedReader frame = frame_of(page, 2);
  for (const auto& displacement : frame.displacements({{0, 8}}, 8)) EXPECT_FLOAT_EQ(displacement[0], 0.25F);
  const std::vector<float> velocities = frame.reals(8, 3);
  for (std::size_t point = 0; point < 8; ++point) EXPECT_FLOAT_EQ(velocities[3 * point], 1.0F);
  for (const float stress : frame.reals(8, 6)) EXPECT_EQ(stress, 0.0F);
  EXPECT_TRUE(frame.at_end());
}

TEST_F(ViewCommand, CurvedFramesLookLikeDividedOnes) {
  const auto page_with = [&](const std::string& curved) {
    simulate({"--force", "--set", "block.0.order=2", "--set", "block.0.angular_velocity=[0, 1, 0]", "--set",
              "output.curved=" + curved});
    EXPECT_EQ(run({"view", (folder / "out").string()}), exit_status::done) << err.str();
    return read_text(folder / "out" / "view.html");
  };
  const std::string divided = page_with("false");
  const std::string curved = page_with("true");
  EXPECT_THAT(read_text(folder / "out" / "summary.json"), HasSubstr("\"curved\": true"));
  const auto divided_scene = nlohmann::json::parse(scene_of(divided));
  const auto curved_scene = nlohmann::json::parse(scene_of(curved));
  EXPECT_EQ(divided_scene["cells"], curved_scene["cells"]);
  const int points = divided_scene["points"];
  PackedReader divided_frame = frame_of(divided, 3), curved_frame = frame_of(curved, 3);
  const auto expected = divided_frame.displacements({{0, points}}, points);
  const auto seen = curved_frame.displacements({{0, points}}, points);
  ASSERT_EQ(seen.size(), expected.size());
  // Both are rounded to whole numbers, of which 32767 stand for the power of two above the spread: one of them apart at most.
  std::array<double, 3> mean{};
  for (const auto& place : expected)
    for (std::size_t k = 0; k < 3; ++k) mean[k] += place[k] / points;
  double spread = 0.0;
  for (const auto& place : expected)
    for (std::size_t k = 0; k < 3; ++k) spread = std::max(spread, std::abs(place[k] - mean[k]));
  EXPECT_GT(spread, 0.1) << "a block of 1 m turns by 0.375 rad";
  const double word = std::exp2(std::ceil(std::log2(spread))) / 32767.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(seen[i][k], expected[i][k], 1.001 * word);
  // sign(q) m (q / 32767)^2: neighbours are 2 sqrt(|v| m) / 32767 + m / 32767^2 apart.
  const std::vector<float> expected_velocity = divided_frame.reals(points, 3);
  const std::vector<float> seen_velocity = curved_frame.reals(points, 3);
  ASSERT_EQ(seen_velocity.size(), expected_velocity.size());
  double largest = 0.0;
  for (const float value : expected_velocity)
    largest = std::max(largest, std::abs(static_cast<double>(value)));
  EXPECT_GT(largest, 1.0) << "it falls at 1 m/s and turns";
  for (std::size_t i = 0; i < seen_velocity.size(); ++i) {
    const double value = expected_velocity[i];
    const double apart = 2.0 * std::sqrt(std::abs(value) * largest) / 32767.0 + largest / (32767.0 * 32767.0);
    EXPECT_NEAR(seen_velocity[i], value, 1.001 * apart);
  }
}

TEST_F(ViewCommand, ThePageAsksForNothingElse) {
  simulate();
  ASSERT_EQ(run({"view", (folder / "out").string(), "-o", (folder / "p.html").string()}), exit_status::done);
  const std::string page = read_text(folder / "p.html");
  for (const char* link : {" src=", "<link", "@import", "@LIBRARIES@", "@SCRIPT@", "@FRAMES@"})
    EXPECT_THAT(page, Not(HasSubstr(link))) << link;
  EXPECT_THAT(scene_of(page), Not(HasSubstr("<b>")));
}

TEST_F(ViewCommand, RunWritesItAtTheEnd) {
  simulate({"--view"});
  EXPECT_THAT(scene_of(read_text(folder / "out" / "view.html")), HasSubstr("completed"));
}

TEST_F(ViewCommand, LongRunsAreThinned) {
  simulate();
  const auto bytes_with = [&](std::size_t most) {
    return write_view_file(folder / "out", folder / "v.html",
                           {.most_bytes = most, .points = ViewPoints::few, .frame = {}, .relative_to = {}});
  };
  const ViewReport all = bytes_with(50'000'000);
  EXPECT_EQ(all.frames_kept, 5U);
  const ViewReport fewer = bytes_with(all.bytes - 1);
  EXPECT_EQ(fewer.frames_kept, 3U);
  EXPECT_LT(fewer.bytes, all.bytes);
  const ViewReport least =
      write_view_file(folder / "out", folder / "v.html",
                      {.most_bytes = 0, .points = ViewPoints::few, .frame = 3, .relative_to = {}});
  EXPECT_EQ(least.frames_kept, 3U);
  std::vector<int> indices;
  const auto scene = nlohmann::json::parse(scene_of(read_text(folder / "v.html")));
  for (const auto& frame : scene["frames"]) indices.push_back(frame["index"]);
  EXPECT_THAT(indices, ElementsAre(0, 3, 4));
}

TEST_F(ViewCommand, AFolderWithoutSummaryIsShown) {
  simulate();
  std::filesystem::remove(folder / "out" / "summary.json");
  EXPECT_EQ(run({"view", (folder / "out").string()}), exit_status::done) << err.str();
}

TEST_F(ViewCommand, OtherFilesAreNotReplaced) {
  simulate();
  const std::string scene = (folder / "glide.toml").string();
  EXPECT_EQ(run({"view", (folder / "out").string(), "-o", scene}), exit_status::bad_input);
  EXPECT_THAT(err.str(),
              HasSubstr("glide.toml is in the way: it is no page of ashlar, another name is needed"));
  EXPECT_EQ(read_text(scene), scene_text);
  const std::string page = (folder / "page.html").string();
  for (int k = 0; k < 2; ++k)
    EXPECT_EQ(run({"view", (folder / "out").string(), "-o", page}), exit_status::done) << err.str();
}

TEST_F(ViewCommand, FaultsNameTheFile) {
  EXPECT_EQ(run({"view", (folder / "none").string()}), exit_status::bad_input);
  EXPECT_THAT(err.str(), AllOf(HasSubstr("error: no result folder ("), HasSubstr("/none does not exist), ")));
  EXPECT_EQ(run({"view", folder.path().string()}), exit_status::bad_input);
  EXPECT_THAT(err.str(), HasSubstr("error: no results in " + folder.path().string() +
                                   " (neither blocks.pvd nor results.vtkhdf exists), "));
  simulate();
  EXPECT_EQ(run({"view", (folder / "glide.toml").string()}), exit_status::bad_input);
  EXPECT_THAT(err.str(), HasSubstr("glide.toml is a file), "));
  write_text(folder / "out/frames/blocks_0000002.vtu", "");
  EXPECT_EQ(run({"view", (folder / "out").string()}), exit_status::bad_input);
  EXPECT_THAT(err.str(), HasSubstr("blocks_0000002.vtu"));
}

TEST_F(ViewCommand, ArraysOfAnotherShapeNameFileAndArray) {
  const auto view_with = [&](const std::string& file, const std::string& name, int components, auto value) {
    simulate({"--force"});
    UnstructuredGrid grid = read_vtu(folder / "out/frames" / file);
    const auto change = [&](std::vector<DataArray>& arrays, std::size_t tuples) {
      for (DataArray& array : arrays) {
        if (array.name != name) continue;
        array.components = components;
        array.component_names.clear();
        array.values = std::vector(tuples * static_cast<std::size_t>(components), value);
      }
    };
    change(grid.point_data, grid.points.size());
    change(grid.cell_data, grid.types.size());
    write_vtu(folder / "out/frames" / file, grid);
    err.str("");
    EXPECT_EQ(run({"view", (folder / "out").string()}), exit_status::bad_input) << file << ' ' << name;
    return err.str();
  };
  const std::string first = "blocks_0000000.vtu";
  const std::string later = "blocks_0000002.vtu";
  const std::string contacts = "contacts_0000001.vtu";
  EXPECT_THAT(view_with(first, "displacement", 1, 0.0),
              HasSubstr(first + ": array 'displacement' has 1 components, 3 needed"));
  EXPECT_THAT(view_with(first, "displacement", 3, 0),
              HasSubstr(first + ": array 'displacement' has the wrong type, Float64 is needed"));
  EXPECT_THAT(view_with(first, "block", 1, 0.0),
              HasSubstr(first + ": array 'block' has the wrong type, Int32 is needed"));
  EXPECT_THAT(view_with(first, "order", 2, 0),
              HasSubstr(first + ": array 'order' has 2 components, 1 needed"));
  EXPECT_THAT(view_with(later, "velocity", 2, 0.0), HasSubstr(later + ": array 'velocity' has 2 components"));
  EXPECT_THAT(view_with(later, "stress", 9, 0.0), HasSubstr(later + ": array 'stress' has 9 components"));
  for (const std::string name : {"force", "normal"})
    EXPECT_THAT(view_with(contacts, name, 1, 0.0),
                HasSubstr(contacts + ": array '" + name + "' has 1 components"));
  for (const std::string name : {"gap", "area"})
    EXPECT_THAT(view_with(contacts, name, 3, 0.0),
                HasSubstr(contacts + ": array '" + name + "' has 3 components"));
}

TEST_F(ViewCommand, ARunInStagesHasTimesIfOneOfThemMoves) {
  simulate();
  const auto analysis_with = [&](const std::string& stages) {
    write_text(folder / "out/summary.json",
               R"({"scene": {"analysis": {"type": "static"}, "stage": [)" + stages + "]}}");
    EXPECT_EQ(run({"view", (folder / "out").string()}), exit_status::done) << err.str();
    return nlohmann::json::parse(scene_of(read_text(folder / "out" / "view.html")))["analysis"];
  };
  const std::string rest = R"({"analysis": {"type": "static"}})";
  EXPECT_EQ(analysis_with(""), "static");
  EXPECT_EQ(analysis_with(rest), "static");
  EXPECT_EQ(analysis_with(rest + R"(, {"analysis": {"type": "dynamic"}})"), "dynamic");
}

TEST_F(ViewCommand, ASummaryThatIsNoneIsNamed) {
  simulate();
  const auto view_with = [&](const std::string& text) {
    write_text(folder / "out/summary.json", text);
    err.str("");
    EXPECT_EQ(run({"view", (folder / "out").string()}), exit_status::bad_input) << text.substr(0, 20);
    return err.str();
  };
  EXPECT_THAT(view_with(std::string(100'000, '[') + std::string(100'000, ']')),
              HasSubstr("summary.json: it is nested more than 100 deep"));
  EXPECT_THAT(view_with("{\"status\": "), HasSubstr("summary.json: it is no JSON from byte"));
  EXPECT_THAT(view_with(""), HasSubstr("summary.json: it is no JSON"));
}

}  // namespace
}  // namespace ashlar::view_command_test

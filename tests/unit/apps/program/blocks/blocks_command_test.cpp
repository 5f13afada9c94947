#include "apps/program/blocks/blocks_command.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/program/blocks/block_histogram.hpp"
#include "geometry/mesh/mesh_io.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::blocks_command_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

// Two cubes of 1 m cut from a bar, on a slab that supports both; the joint between them is loose.
const std::string bar = R"(title = "bar"
analysis = { end_time = 0.01, time_step = 1e-3 }
contact = { friction_angle = 45 }
material = [{ name = "rock", density = 2700, young_modulus = 1e9, poisson_ratio = 0.2 }]
[[block]]
name = "slab"
fixed = true
box = { min = [-1, -1, -1], max = [3, 2, 0] }
[[block]]
name = "bar"
material = "rock"
box = { min = [0, 0, 0], max = [2, 1, 1] }
[[cut]]
name = "middle"
blocks = ["bar"]
dip = 90
dip_direction = 90
point = [1, 0, 0]
)";

class BlocksCommand : public ::testing::Test {
 protected:
  int run(BlocksOptions options, const std::string& more = "") {
    write_text(folder_ / "bar.toml", bar + more);
    options.scene = folder_ / "bar.toml";
    out_.str("");
    err_.str("");
    return blocks_command(options, out_, err_);
  }

  TemporaryFolder folder_;
  std::ostringstream out_, err_;
};

TEST_F(BlocksCommand, JsonHasPlacesAndOtherNames) {
  BlocksOptions options;
  options.json = true;
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  const auto blocks = nlohmann::json::parse(out_.str()).at("blocks");
  EXPECT_EQ(blocks.at(0).at("centroid"), (nlohmann::json{1.0, 0.5, -0.5}));
  EXPECT_EQ(blocks.at(0).at("names"), nlohmann::json::array());
  EXPECT_EQ(blocks.at(2).at("names"), (nlohmann::json{"bar.middle.2"}));
  EXPECT_EQ(blocks.at(2).at("box"), nlohmann::json::parse(R"({ "min": [1, 0, 0], "max": [2, 1, 1] })"));
}

// With its neighbour gone, a cube is free to move along x; the end of the bar was free before.
TEST_F(BlocksCommand, BlocksOfAStage) {
  const std::string stages =
      "[[stage]]\nname = \"all\"\n[[stage]]\nname = \"one\"\nremove = [\"bar.1\"]\nreset_displacement = "
      "true\n";
  BlocksOptions options;
  options.json = true;
  options.stage = "one";
  options.force = "-1,0,0";
  ASSERT_EQ(run(options, stages), exit_status::done) << err_.str();
  const auto one = nlohmann::json::parse(out_.str());
  EXPECT_EQ(one.at("count"), 2);
  EXPECT_EQ(one.at("volume"), 13.0);
  EXPECT_EQ(one.at("blocks").at(1).at("name"), "bar.2");
  EXPECT_EQ(one.at("blocks").at(1).at("neighbours").size(), 1U);
  EXPECT_EQ(one.at("blocks").at(1).at("key").at("direction"), (nlohmann::json{-1.0, 0.0, 0.0}));
  options.stage = "all";
  ASSERT_EQ(run(options, stages), exit_status::done) << err_.str();
  const auto all = nlohmann::json::parse(out_.str());
  EXPECT_EQ(all.at("count"), 3);
  EXPECT_NE(all.at("blocks").at(2).at("key").at("direction"), (nlohmann::json{-1.0, 0.0, 0.0}));
  options.stage = "on";
  EXPECT_EQ(run(options, stages), exit_status::bad_input);
  EXPECT_THAT(err_.str(), HasSubstr("no stage of that name (--stage on), did you mean \"one\"?"));
}

TEST_F(BlocksCommand, JsonHasTheContract) {
  BlocksOptions options;
  options.json = true;
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  const auto json = nlohmann::json::parse(out_.str());
  EXPECT_EQ(json.at("count"), 3);
  EXPECT_EQ(json.at("volume"), 14.0);
  const auto& one = json.at("blocks").at(1);
  EXPECT_EQ(one.at("name"), "bar.1");
  EXPECT_EQ(one.at("volume"), 1.0);
  EXPECT_EQ(one.at("faces"), 6);
  EXPECT_EQ(one.at("material"), "rock");
  EXPECT_TRUE(json.at("blocks").at(0).at("material").is_null());
  ASSERT_EQ(one.at("neighbours").size(), 2U);
  EXPECT_EQ(one.at("neighbours").at(0).at("block"), "slab");
  EXPECT_EQ(one.at("neighbours").at(0).at("area"), 1.0);
  EXPECT_TRUE(one.at("neighbours").at(0).at("cut").is_null());
  EXPECT_EQ(one.at("neighbours").at(1).at("block"), "bar.2");
  EXPECT_EQ(one.at("neighbours").at(1).at("area"), 1.0);
  EXPECT_EQ(one.at("neighbours").at(1).at("cut"), "middle");
  EXPECT_FALSE(one.contains("key"));
}

// Stages, assignments and joints are written with the names that it lists.
TEST_F(BlocksCommand, ListsTheBlocksWhereNamesOfPiecesAreWrong) {
  BlocksOptions options;
  options.json = true;
  const std::string stage = "[[stage]]\nname = \"one\"\nremove = [\"bar.1.inside*\"]\n";
  const std::string joint = "[[joint]]\nblocks = [\"bar.left\", \"slab\"]\nfriction_angle = 20\n";
  const std::string assign = "[[assign]]\nblocks = [\"bar.x\"]\nfixed = true\n";
  ASSERT_EQ(run(options, stage + joint + assign), exit_status::done) << err_.str();
  const auto json = nlohmann::json::parse(out_.str());
  EXPECT_EQ(json.at("blocks").at(1).at("name"), "bar.1");
  const std::string alike =
      "\"bar.1\" to \"bar.2\" begin alike; the name of a [[block]] or a glob that matches one is needed";
  EXPECT_THAT(err_.str(), HasSubstr("bar.toml:21:10: warning: stage names no block (\"bar.1.inside*\"), "));
  EXPECT_THAT(err_.str(), HasSubstr("bar.toml:23:10: warning: joint names no block (\"bar.left\"), "));
  EXPECT_THAT(err_.str(), HasSubstr("bar.toml:26:10: warning: assign names no block (\"bar.x\"), "));
  EXPECT_THAT(err_.str(), HasSubstr(alike));
  EXPECT_EQ(err_.str().find("error"), std::string::npos) << err_.str();
  // Other faults are errors as ever.
  EXPECT_EQ(run(options, "[[stage]]\nname = 3\n"), exit_status::bad_input);
}

TEST_F(BlocksCommand, RemovableByItsForce) {
  BlocksOptions options;
  options.json = true;
  options.force = "0,0,-1";
  ASSERT_EQ(run(options), exit_status::done);
  auto key = nlohmann::json::parse(out_.str()).at("blocks").at(1).at("key");
  EXPECT_EQ(key.at("mode"), "stable");
  EXPECT_TRUE(key.at("removable"));
  EXPECT_TRUE(key.at("finite"));
  EXPECT_TRUE(key.at("factor_of_safety").is_null());
  // Away from the other cube, down and aside at the same rate: friction of 45 degrees just holds.
  options.force = "-1,0,-1";
  ASSERT_EQ(run(options), exit_status::done);
  key = nlohmann::json::parse(out_.str()).at("blocks").at(1).at("key");
  EXPECT_EQ(key.at("mode"), "sliding on one face");
  EXPECT_EQ(key.at("direction"), (std::vector<double>{-1.0, 0.0, 0.0}));
  EXPECT_NEAR(key.at("factor_of_safety").get<double>(), 1.0, 1e-15);
  // The slab is fixed: not looked at.
  EXPECT_FALSE(nlohmann::json::parse(out_.str()).at("blocks").at(0).contains("key"));
}

TEST_F(BlocksCommand, WritesItsFiles) {
  BlocksOptions options;
  options.folder = folder_ / "out";
  options.force = "0,0,1";
  ASSERT_EQ(run(options), exit_status::done) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("3 blocks, 14 m^3; least 1, median 1, largest 12 m^3\n"));
  EXPECT_THAT(out_.str(), HasSubstr("cut middle: 1 m^2 between blocks\n"));
  EXPECT_THAT(out_.str(), ContainsRegex("bar.1 +1 +0 .*falling\n"));
  const std::string obj = read_text(folder_ / "out" / "blocks.obj");
  EXPECT_THAT(obj, HasSubstr("g bar.2\n"));
  EXPECT_THAT(obj, HasSubstr("f 17 ")) << "points are counted over all groups";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "blocks.vtu"));
  const std::string stl = read_text(folder_ / "out" / "blocks.stl");
  EXPECT_THAT(stl, HasSubstr("endsolid slab\nsolid bar.1\nfacet normal"));
  // The solids of an STL file are one mesh to its reader; together they have the volume of all.
  EXPECT_NEAR(rounded_volume(read_mesh(folder_ / "out" / "blocks.stl")), 14.0, 1e-12);
  const std::string msh = read_text(folder_ / "out" / "blocks.msh");
  EXPECT_THAT(msh, HasSubstr("$PhysicalNames\n3\n2 1 \"slab\"\n2 2 \"bar.1\"\n2 3 \"bar.2\"\n"));
  // 8 corners and 12 triangles each.
  EXPECT_THAT(msh, HasSubstr("$Nodes\n24\n"));
  EXPECT_THAT(msh, HasSubstr("$Elements\n36\n1 2 2 1 1 "));
  const std::vector<MeshGroup> back = read_mesh_groups(folder_ / "out" / "blocks.msh");
  ASSERT_EQ(back.size(), 3U);
  EXPECT_EQ(back[1].name, "bar.1");
  EXPECT_NEAR(rounded_volume(back[0].mesh), 12.0, 1e-14);
  EXPECT_NEAR(rounded_volume(back[2].mesh), 1.0, 1e-15);
  EXPECT_THAT(read_text(folder_ / "out" / "sizes.py"), HasSubstr("share in blocks up to this volume"));
}

TEST_F(BlocksCommand, RefusesWhatIsNoDirection) {
  BlocksOptions options;
  for (const char* force : {"0,0,0", "1,2", "down", "1,2,3,4", "1,nan,0"}) {
    options.force = force;
    EXPECT_EQ(run(options), exit_status::bad_input) << force;
    EXPECT_THAT(err_.str(),
                HasSubstr("--removable is not a direction (" + std::string(force) + "), three numbers"));
  }
}

TEST(BlockHistogram, SharesRiseAtEachVolume) {
  const Plot plot = size_plot("t", {3.0, 1.0});
  EXPECT_EQ(plot.series.at(0).x, (std::vector<double>{1.0, 1.0, 3.0, 3.0}));
  EXPECT_EQ(plot.series.at(0).y, (std::vector<double>{0.0, 25.0, 25.0, 100.0}));
  EXPECT_EQ(plot.series.at(1).y, (std::vector<double>{0.0, 50.0, 50.0, 100.0}));
}

TEST(BlockHistogram, ClassesAreOneTwoFive) {
  const std::vector<SizeClass> classes = size_classes({0.5, 0.7, 1.0, 4.9});
  ASSERT_EQ(classes.size(), 3U);
  EXPECT_EQ(classes[0].from, 0.5);
  EXPECT_EQ(classes[0].blocks, 2);
  EXPECT_EQ(classes[1].from, 1.0);
  EXPECT_EQ(classes[1].blocks, 1);
  EXPECT_EQ(classes[2].to, 5.0);
  EXPECT_EQ(classes[2].volume, 4.9);
  const std::vector<SizeClass> decades = size_classes({3e-10, 0.1, 2.0});
  EXPECT_EQ(decades.front().from, 1e-10);
  EXPECT_EQ(decades.front().blocks, 1);
  EXPECT_EQ(decades.back().to, 10.0);
  EXPECT_EQ(decades.back().blocks, 1);
}

}  // namespace
}  // namespace ashlar::blocks_command_test

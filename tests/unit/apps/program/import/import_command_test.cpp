// From the file of another program to a verdict that is known by hand.
#include "apps/program/import/import_command.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "apps/results/text/json_text.hpp"
#include "geometry/triangle_mesh.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::import_command_test {
namespace {

using ::testing::HasSubstr;

class ImportCommand : public ::testing::Test {
 protected:
  int import(const std::filesystem::path& file, std::vector<std::string> fixed = {}) {
    printed_.str("");
    faults_.str("");
    return import_command({file, folder_ / "model.toml", std::move(fixed), true}, printed_, faults_);
  }

  /// Imports a file, and runs its scene. @return the status of the analysis
  std::string verdict(const std::filesystem::path& file, std::vector<std::string> fixed = {}) {
    EXPECT_EQ(import(file, std::move(fixed)), exit_status::done) << faults_.str();
    (void)run_command_line(
        {"run", (folder_ / "model.toml").string(), "--out", (folder_ / "out").string(), "--force", "--quiet"},
        printed_, faults_);
    const std::string summary = read_text(folder_ / "out" / "summary.json");
    return summary.empty() ? faults_.str() : parse_json(summary)["status"].get<std::string>();
  }

  TemporaryFolder folder_;
  std::ostringstream printed_, faults_;
};

/// A box of COMPAS from its lower to its upper corner, turned about y by an angle in degrees.
std::string box(const Vector3& low, const Vector3& high, double angle) {
  const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
  std::string vertices;
  for (int k = 0; k < 8; ++k) {
    const double x = (k & 1) != 0 ? high.x() : low.x(), y = (k & 2) != 0 ? high.y() : low.y(),
                 z = (k & 4) != 0 ? high.z() : low.z();
    vertices += fmt::format("{}\"{}\": {{\"x\": {}, \"y\": {}, \"z\": {}}}", k == 0 ? "" : ", ", k,
                            c * x + s * z, y, c * z - s * x);
  }
  return R"({"dtype": "compas_assembly.datastructures/Block", "data": {"vertex": {)" + vertices +
         R"(}, "face": {"0": [0, 2, 3, 1], "1": [4, 5, 7, 6], "2": [0, 1, 5, 4], "3": [2, 6, 7, 3], "4": [0, 4, 6, 2],
            "5": [1, 3, 7, 5]}}})";
}

// The assumed friction, a coefficient of 0.6, holds a block on a slope up to 30.96 degrees.
TEST_F(ImportCommand, ABlockOfCompasStandsOnASlopeBelowItsFriction) {
  for (const auto& [angle, status] : {std::pair(30.0, "equilibrium"), std::pair(32.0, "moving")}) {
    write_text(folder_ / "slope.json",
               R"({"data": {"graph": {"data": {"node": {"0": {"is_support": true, "block": )" +
                   box({-3, -2, -1}, {3, 2, 0}, angle) + R"(}, "1": {"block": )" +
                   box({-1, -1, 0}, {1, 1, 0.5}, angle) + "}}}}}}");
    EXPECT_EQ(verdict(folder_ / "slope.json"), status) << angle;
  }
  EXPECT_THAT(faults_.str(), HasSubstr("ashlar: note: friction is not in the file"));
  EXPECT_THAT(printed_.str(), HasSubstr("blocks: 2 in "));
}

// A brick of 2 m on one of 2 m tips where its middle is beside the lower one.
TEST_F(ImportCommand, ABrickOf3decTipsBeyondItsMiddle) {
  for (const auto& [shift, status] : {std::pair(0.95, "equilibrium"), std::pair(1.05, "moving")}) {
    write_text(folder_ / "bricks.3ddat", fmt::format("poly brick 0 2 0 1 0 1\npoly reg 7 brick {} {} 0 1 1 "
                                                     "2\nprop mat 1 dens 2000\nprop jmat 1 jfric 40\n"
                                                     "fix range z 0 1\n",
                                                     shift, 2 + shift));
    EXPECT_EQ(verdict(folder_ / "bricks.3ddat"), status) << shift;
  }
}

// A cube of 1 m^3 and 2000 kg under a horizontal force: friction of 0.5 holds 9810 N.
TEST_F(ImportCommand, ABodyOfLmgc90SlidesBeyondItsFriction) {
  std::string vertices;
  for (int k = 0; k < 8; ++k)
    vertices += fmt::format(" coo1= {}  coo2= {}  coo3= {}\n", (k & 1) != 0 ? "0.5D+00" : "-0.5D+00",
                            (k & 2) != 0 ? "0.5D+00" : "-0.5D+00", (k & 4) != 0 ? "0.5D+00" : "-0.5D+00");
  const std::string faces =
      " ver1= 1 ver2= 3 ver3= 4\n ver1= 1 ver2= 4 ver3= 2\n ver1= 5 ver2= 6 ver3= 8\n ver1= 5 ver2= 8 ver3= "
      "7\n"
      " ver1= 1 ver2= 2 ver3= 6\n ver1= 1 ver2= 6 ver3= 5\n ver1= 3 ver2= 7 ver3= 8\n ver1= 3 ver2= 8 ver3= "
      "4\n"
      " ver1= 1 ver2= 5 ver3= 7\n ver1= 1 ver2= 7 ver3= 3\n ver1= 2 ver2= 4 ver3= 8\n ver1= 2 ver2= 8 ver3= "
      "6\n";
  const auto body = [](const std::string& material, const std::string& height, const std::string& contactor) {
    return "$bdyty\n RBDY3 1\n$blmty\n PLAIN 1 behav " + material +
           " avrd= 0.0D+00\n$nodty\n NO6xx 1 coo1= 0.0D+00 coo2= 0.0D+00 coo3= " + height +
           "\n coo4= 0.0D+00 coo5= 0.0D+00 coo6= 0.0D+00\n$tacty\n" + contactor + "$$$$$$\n";
  };
  const std::filesystem::path data = folder_ / "DATBOX";
  std::filesystem::create_directory(data);
  write_text(
      data / "BODIES.DAT",
      body("STONE", "0.5000000D+00", " POLYR 1 color REDxx nb_vertex= 8 nb_face= 12\n" + vertices + faces) +
          body("STONE", "-0.5000000D+00",
               " PLANx 1 color VERTx axe1= 0.3D+01 axe2= 0.3D+01 axe3= 0.5D+00\n"));
  write_text(
      data / "BULK_BEHAV.DAT",
      "$gravy\n grv1= 0.0D+00 grv2= 0.0D+00 grv3=-0.981D+01\n$behav lawty\n STONE RIGID Umas= 0.2D+04\n");
  write_text(data / "TACT_BEHAV.DAT",
             "$behav lawty\n iqsc0 IQS_CLB fric= 0.5D+00\n$seety\n RBDY3 POLYR REDxx iqsc0 RBDY3 PLANx VERTx "
             "0.5D-02\n");
  for (const auto& [force, status] :
       {std::pair("0.9700D+04", "equilibrium"), std::pair("0.9900D+04", "moving")}) {
    std::string driven = "$bdyty\n RBDY3 2\n$nodty\n NO6xx 1\n$dofty\n";
    for (int k = 1; k <= 6; ++k) driven += fmt::format(" vlocy {} 0.0 0.0 0.0 0.0 1.0 0.0\n", k);
    driven += fmt::format(
        "$$$$$$\n$bdyty\n RBDY3 1\n$nodty\n NO6xx 1\n$dofty\n force 1 {} 0.0 0.0 0.0 1.0 0.0\n$$$$$$\n",
        force);
    write_text(data / "DRV_DOF.DAT", driven);
    EXPECT_EQ(verdict(folder_.path()), status) << force;
  }
}

// A cube beside a fixed one: it hangs where it is bonded, and falls where it is not.
TEST_F(ImportCommand, ABlockOfUnblocksHangsByItsBond) {
  for (const auto& [bonds, status] : {std::pair("1\n0 1 0 0 4", "equilibrium"), std::pair("0", "moving")}) {
    std::string points, corners, faces;
    for (int block = 0; block < 2; ++block) {
      for (int k = 0; k < 8; ++k)
        points += fmt::format("{} {} {}\n", block + (k & 1), (k >> 1) & 1, (k >> 2) & 1);
      corners += "0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5 \n";
    }
    for (int k = 0; k < 12; ++k) faces += fmt::format("{} 4\n", 4 * k);
    write_text(folder_ / "rock.dda",
               "#_DDA_DataFile_Version_1.0\nPOINTS_START_LENGTH 2\n0 8\n8 8\nPOINTS 16 double\n" + points +
                   "FACES_NODELIST 48\n" + corners + "FACES 12\n" + faces +
                   "BLOCK_FACES 2\n0 6\n6 6\nSCALARS fixedFlag int\n1\n0\nBond: " + bonds + "\n");
    EXPECT_EQ(verdict(folder_ / "rock.dda"), status) << bonds;
  }
}

// Its support moves along by 0.1 m, and the block with it.
TEST_F(ImportCommand, ASupportOfCompasMoves) {
  const auto element = [](const std::string& mesh) {
    return R"({"data": {"transformation": null, "geometry": )" + mesh + R"(, "is_support": false}})";
  };
  write_text(folder_ / "moves.json",
             R"({"data": {"model": {"data": {"elements": {"a": )" + element(box({-3, -2, -1}, {3, 2, 0}, 0)) +
                 R"(, "b": )" + element(box({-1, -1, 0}, {1, 1, 0.5}, 0)) +
                 R"(}, "graph": {"node": {"0": {"element": "a"}, "1": {"element": "b"}}}}},
             "boundary_conditions": {"data": {"gravity": true, "displacements":
               [{"block_index": 0, "translation": [0.1, 0, 0], "rotation": [0, 0, 0]}]}}}})");
  ASSERT_EQ(verdict(folder_ / "moves.json"), "equilibrium");
  const auto largest =
      parse_json(read_text(folder_ / "out" / "summary.json"))["largest_displacement"]["value"];
  EXPECT_NEAR(largest.get<double>(), 0.1, 1e-6);
}

TEST_F(ImportCommand, AMeshIsNamedByItsScene) {
  write_text(folder_ / "stones.obj",
             "o ground\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 -4\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"
             "o stone\nv 0.5 0.5 0\nv 1 0.5 0\nv 0.5 1 0\nv 0.5 0.5 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n");
  EXPECT_EQ(verdict(folder_ / "stones.obj", {"ground"}), "equilibrium");
  EXPECT_THAT(read_text(folder_ / "model.toml"),
              HasSubstr("mesh = { file = \"stones.obj\", split = \"groups\""));
}

TEST_F(ImportCommand, FaultsHaveTheirPlaceAndNothingIsWritten) {
  const auto fault = [&](const std::string& name, const std::string& text) {
    write_text(folder_ / name, text);
    EXPECT_EQ(import(folder_ / name), exit_status::bad_input);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "model.toml"));
    return faults_.str();
  };
  EXPECT_THAT(fault("a.json", "{"), HasSubstr("a.json:1:2: error: text is no JSON"));
  EXPECT_THAT(fault("a.dat", "poly drum\n"), HasSubstr("a.dat:1:6: error: shape of poly (drum)"));
  EXPECT_THAT(fault("house.ifc", "ISO-10303-21;"),
              HasSubstr("house.ifc: error: IFC files are not read: IfcConvert"));
  EXPECT_THAT(fault("a.3dm", ""), HasSubstr("3DM files are not read: Rhino, or rhino3dm"));
  EXPECT_THAT(fault("a.foo", ""), HasSubstr("unknown kind of model (a.foo)"));
  EXPECT_EQ(import(folder_ / "missing.json"), exit_status::bad_input);
  EXPECT_THAT(faults_.str(), HasSubstr("missing.json: error: "));
  EXPECT_EQ(import(folder_.path()), exit_status::bad_input);
  EXPECT_THAT(faults_.str(), HasSubstr("folder has no BODIES.DAT"));
  EXPECT_EQ(import_command({folder_ / "a.json", folder_ / "scene.txt", {}, true}, printed_, faults_),
            exit_status::bad_input);
  EXPECT_THAT(faults_.str(), HasSubstr("is no scene"));
}

TEST_F(ImportCommand, ReplacesFilesOnlyIfAsked) {
  write_text(folder_ / "a.dat", "poly brick 0 1 0 1 0 1\nfix\n");
  write_text(folder_ / "b.obj", "mine");
  EXPECT_EQ(import_command({folder_ / "a.dat", folder_ / "b.toml", {}, false}, printed_, faults_),
            exit_status::bad_input);
  EXPECT_THAT(faults_.str(), HasSubstr("b.obj exists"));
  EXPECT_EQ(read_text(folder_ / "b.obj"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.toml"));
}

}  // namespace
}  // namespace ashlar::import_command_test

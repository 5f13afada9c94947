#include "apps/scene/import/lmgc90_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/temporary_folder.hpp"

namespace ashlar::lmgc90_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A tetrahedron of 32 / 3 m^3 along the axes from the place, its second face turned inside.
std::string body(const std::string& colour, const std::string& place, const std::string& inertia) {
  return fmt::format(R"($bdyty
 RBDY3      1
$blmty
 PLAIN      1  behav  STONE  avrd= {}  gyrd= 0.0000000D+00
                             I1  = 0.0000000D+00  I2  = 0.0000000D+00  I3  = 0.0000000D+00
$nodty
 NO6xx      1                {}
                             coo4= 0.0000000D+00  coo5= 0.0000000D+00  coo6= 0.0000000D+00
$tacty
 POLYR      1  color  {}  nb_vertex=    4      nb_face=    4
                             coo1= 0.0000000D+00  coo2= 0.0000000D+00  coo3= 0.0000000D+00
                             coo1= 0.4000000D+01  coo2= 0.0000000D+00  coo3= 0.0000000D+00
                             coo1= 0.0000000D+00  coo2= 0.4000000D+01  coo3= 0.0000000D+00
                             coo1= 0.0000000D+00  coo2= 0.0000000D+00  coo3= 0.4000000D+01
                             ver1= 1              ver2= 3              ver3= 2
                             ver1= 4              ver2= 2              ver3= 1
                             ver1= 2              ver2= 3              ver3= 4
                             ver1= 1              ver2= 4              ver3= 3
$$$$$$
)",
                     inertia, place, colour);
}

const std::string at_origin = "coo1= 0.0000000D+00  coo2= 0.0000000D+00  coo3= 0.0000000D+00";
const std::string at_3 = "coo1= 0.3000000D+01  coo2= 0.0000000D+00  coo3=-0.5000000D+00";
const std::string plane = R"($bdyty
 RBDY3      1
$blmty
 PLAIN      1  behav  tdurx  avrd= 0.0000000D+00  gyrd= 0.0000000D+00
$nodty
 NO6xx      1                coo1= 0.0000000D+00  coo2= 0.0000000D+00  coo3=-0.2500000D+00
                             coo4= 0.0000000D+00  coo5= 0.0000000D+00  coo6= 0.0000000D+00
$tacty
 PLANx      1 color   VERTx  axe1= 0.9000000D+01  axe2= 0.8000000D+01  axe3= 0.2500000D+00
$$$$$$
)";
const std::string bulk = R"(! File BEHAVIOUR
$gravy
                   grv1= 0.0000000D+00  grv2= 0.0000000D+01  grv3=-0.9810000D+01

$behav  lawty
 STONE  RIGID                           Umas= 0.2700000D+04
)";
const std::string contact = R"($behav  lawty
 iqsc0  IQS_CLB                         fric= 0.5000000D+00
$behav  lawty
 iqsc1  IQS_DS_CLB                      dyfr= 0.3000000D+00
                                        stfr= 0.2500000D+00
$seety
 cdbdy  cdtac  cdcol  behav  anbdy  antac  ancol       alert
 RBDY3  POLYR  REDxx  iqsc0  RBDY3  PLANx  VERTx       0.5000000D-02
$seety
 cdbdy  cdtac  cdcol  behav  anbdy  antac  ancol       alert
 RBDY3  POLYR  REDxx  iqsc1  RBDY3  POLYR  BLEUx       0.5000000D-02
)";

std::string driven(int number, const std::string& lines) {
  return fmt::format("$bdyty\n RBDY3    {}\n$nodty\n NO6xx      1\n$dofty  [CT + AMP * cos]\n{}$$$$$$\n",
                     number, lines);
}
std::string six_zeros() {
  std::string lines;
  for (int k = 1; k <= 6; ++k)
    lines += fmt::format(" vlocy      {}  0.0D+00  0.0D+00  0.0D+00  0.0D+00  0.1D+01  0.0D+00\n", k);
  return lines;
}

class Lmgc90 : public ::testing::Test {
 protected:
  ImportedModel read() { return read_lmgc90(folder_ / "BODIES.DAT"); }
  void write(const char* file, const std::string& text) { write_text(folder_ / file, text); }
  std::string refusal() {
    try {
      (void)read();
    } catch (const ImportError& error) {
      return fmt::format("{}:{}:{}: {}", std::filesystem::path(error.place().origin).filename().string(),
                         error.place().line, error.place().column, error.what());
    }
    return "none";
  }

  TemporaryFolder folder_;
};

TEST_F(Lmgc90, BodiesHavePlacesMaterialsAndSupports) {
  write("BODIES.DAT",
        "! comment\n" + body("REDxx", at_origin, "0.0D+00") + body("BLEUx", at_3, "0.0D+00") + plane);
  write("BULK_BEHAV.DAT", bulk);
  write("TACT_BEHAV.DAT", contact);
  write("DRV_DOF.DAT",
        driven(3, six_zeros()) +
            driven(1, " force      3 -0.700000D+05  0.0D+00  0.0D+00  0.0D+00  0.1D+01  0.0D+00\n"));
  const ImportedModel model = read();
  ASSERT_EQ(model.blocks.size(), 3U);
  EXPECT_EQ(model.blocks[0].name, "REDxx_1");
  EXPECT_EQ(centroid_of(model.blocks[0]), Vector3(1, 1, 1));
  EXPECT_EQ(centroid_of(model.blocks[1]), Vector3(4, 1, 0.5));
  EXPECT_EQ(model.blocks[2].name, "VERTx_3");
  EXPECT_EQ(box_of(model.blocks[2]).low, Vector3(-9, -8, -0.5));
  EXPECT_EQ(box_of(model.blocks[2]).high, Vector3(9, 8, 0));
  EXPECT_TRUE(model.blocks[2].fixed);
  ASSERT_EQ(model.blocks[0].loads.size(), 1U);
  EXPECT_EQ(model.blocks[0].loads[0].point, Vector3(1, 1, 1));
  EXPECT_EQ(model.blocks[0].loads[0].force, Vector3(0, 0, -7e4));
  EXPECT_EQ(*model.gravity, Vector3(0, 0, -9.81));
  EXPECT_EQ(model.materials[0].density, 2700.0);
  EXPECT_DOUBLE_EQ(model.rounding, 0.5e-6);
  // Each pair of colours has its law; blue and green have none, and there is but one body of each colour.
  ASSERT_EQ(model.joints.size(), 2U);
  EXPECT_EQ(model.joints[0].first, "BLEUx_*");
  EXPECT_EQ(model.joints[0].second, "REDxx_*");
  const auto coefficient = [](double angle) { return std::tan(angle * std::numbers::pi / 180); };
  EXPECT_NEAR(coefficient(*model.joints[0].law.friction_angle), 0.25, 1e-15);
  EXPECT_NEAR(coefficient(*model.joints[1].law.friction_angle), 0.5, 1e-15);
  EXPECT_EQ(model.contact.friction_angle, 0.0);
  EXPECT_THAT(model.left_out, ElementsAre(HasSubstr("parts of law iqsc1 (IQS_DS_CLB)")));
  EXPECT_THAT(model.notes,
              Contains(HasSubstr("touch without friction (in LMGC90 they do not touch): BLEUx and VERTx")));
}

TEST_F(Lmgc90, AloneBodiesAreNotedToLackTheRest) {
  write("BODIES.DAT", body("REDxx", at_origin, "0.0D+00"));
  const ImportedModel model = read();
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("gravity is not"), HasSubstr("density of STONE"),
                                       HasSubstr("friction is not")));
}

// A body with given inertia has its vertices in the frame of DOF.INI: here x along y, y along -x.
TEST_F(Lmgc90, FramesTurnBodiesWithInertia) {
  const std::string turned = R"($bdyty
 RBDY3      1
$nodty
 NO6xx      1                X(1)= 0.0D+00  X(2)= 0.0D+00  X(3)= 0.0D+00
                             V(1)= 0.0D+00  V(2)= 0.1D+00  V(3)= 0.0D+00
                             a(1)= 0.0D+00  a(2)= 0.1D+01  a(3)= 0.0D+00
                             b(1)=-0.1D+01  b(2)= 0.0D+00  b(3)= 0.0D+00
                             g(1)= 0.0D+00  g(2)= 0.0D+00  g(3)= 0.1D+01
$$$$$$
)";
  write("BODIES.DAT", body("REDxx", at_3, "0.5D+00"));
  write("DOF.INI", turned);
  EXPECT_EQ(centroid_of(read().blocks[0]), Vector3(2, 1, 0.5));
  EXPECT_THAT(read().left_out, ElementsAre(HasSubstr("velocities of DOF.INI")));
  write("BODIES.DAT", body("REDxx", at_3, "0.0D+00"));
  EXPECT_EQ(centroid_of(read().blocks[0]), Vector3(4, 1, 0.5));
  EXPECT_THAT(read().left_out, Contains(HasSubstr("turned frames of DOF.INI")));
}

TEST_F(Lmgc90, MotionsAndHistoriesAreListed) {
  write("BODIES.DAT", body("REDxx", at_origin, "0.0D+00") + body("REDxx", at_3, "0.0D+00"));
  write("load.DAT", "  0.0  0.0\n  0.1 -5.0\n  2.0 -6.0\n");
  write("DRV_DOF.DAT", driven(1, " vlocy      3 -0.1D+00  0.0D+00  0.0D+00  0.0D+00  0.1D+01  0.0D+00\n") +
                           driven(2, " force      1 evolution load.DAT\n"));
  const ImportedModel model = read();
  EXPECT_TRUE(model.blocks[0].fixed);
  EXPECT_EQ(model.blocks[1].loads[0].force, Vector3(-6, 0, 0));
  EXPECT_THAT(model.left_out, ElementsAre(HasSubstr("velocity of body 1, which is held instead"),
                                          HasSubstr("history of a force or velocity of body 2")));
}

TEST_F(Lmgc90, RefusesAtThePlaceInTheFile) {
  const std::string good = body("REDxx", at_origin, "0.0D+00");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    write("BODIES.DAT", text.replace(text.find(from), from.size(), to));
    return refusal();
  };
  EXPECT_THAT(with("RBDY3", "MAILx"), HasSubstr("BODIES.DAT:2:2: body of kind MAILx is not read"));
  EXPECT_THAT(with("POLYR      1", "SPHER      1"), HasSubstr("10:2: contactor SPHER is not read"));
  EXPECT_THAT(with("ver3= 2", "ver3= 9"), HasSubstr("15:78: ver3 (9), allowed 1 to 4"));
  EXPECT_THAT(with("coo3= 0.4000000D+01", "coo3= four"), HasSubstr("14:78: coo3 (four), must be a number"));
  EXPECT_THAT(with("coo4= 0.0", "coo4= 0.5"), HasSubstr("8:36: body is turned"));
  EXPECT_THAT(with("$$$$$$\n", good), HasSubstr("body without its end"));
  EXPECT_THAT(with("$$$$$$\n", "$tacty\n POLYR 2 color REDxx nb_vertex= 4 nb_face= 4\n$$$$$$\n"),
              HasSubstr("body 1 has several contactors, one is needed: clusters are not read"));
  write("BODIES.DAT", good);
  write("DRV_DOF.DAT", driven(2, six_zeros()));
  EXPECT_THAT(refusal(), HasSubstr("DRV_DOF.DAT:2:11: body 2 is unknown, BODIES.DAT has 1 to 1"));
  write("DRV_DOF.DAT", driven(1, " force      1 evolution ../other\n"));
  EXPECT_THAT(refusal(), HasSubstr("one in the folder of BODIES.DAT is needed"));
}

TEST_F(Lmgc90, FilesThatEndAnywhereAreRefusedOrRead) {
  const std::string bodies = body("REDxx", at_origin, "0.0D+00");
  write("TACT_BEHAV.DAT", contact);
  for (std::size_t size = 0; size < bodies.size(); ++size) {
    write("BODIES.DAT", bodies.substr(0, size));
    EXPECT_TRUE(refusal() != "none" || size >= bodies.find("$$$$$$") + 6) << size;
  }
  write("BODIES.DAT", bodies);
  for (std::size_t size = 0; size < contact.size(); ++size) {
    write("TACT_BEHAV.DAT", contact.substr(0, size));
    (void)refusal();
  }
}

}  // namespace
}  // namespace ashlar::lmgc90_reader_test

// `ashlar run --explain-contacts A,B`.
#include "apps/program/run/contact_report.hpp"

#include <gtest/gtest.h>

#include "unit/apps/run_fixture.hpp"

namespace ashlar::contact_report_test {
namespace {

class ContactReport : public RunCommand {
 protected:
  /// A cube on a slab; names have a comma.
  void write_cube_on_slab() {
    write_text(scene_, std::string(rock_text) + R"(
[analysis]
end_time = 0.01
time_step = 1e-3
[contact]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle = 30
[[block]]
name = "slab, left"
fixed = true
box = { min = [-1, -1, -1], max = [2, 2, 0] }
[[block]]
name = "cube"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[block]]
name = "far"
material = "rock"
box = { min = [0, 0, 50], max = [1, 1, 51] }
)");
  }
};

TEST_F(ContactReport, NamesWhatTheStepUsesAndTheForce) {
  write_cube_on_slab();
  ASSERT_EQ(run("out", {"--explain-contacts", "slab, left,cube"}), 0) << faults_;
  EXPECT_NE(printed_.find("contacts of slab, left and cube at t = 0.01 s"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find(", type F-F"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("  used     face "), std::string::npos) << printed_;
  EXPECT_NE(printed_.find(" open, "), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("force on slab, left: ("), std::string::npos) << printed_;
  const std::string report = printed_;
  ASSERT_EQ(run("again", {"--explain-contacts", "cube,slab, left"}), 0) << faults_;
  EXPECT_EQ(printed_, report);
}

TEST_F(ContactReport, SaysWhyThereAreNone) {
  write_cube_on_slab();
  ASSERT_EQ(run("out", {"--explain-contacts", "cube,far"}), 0) << faults_;
  EXPECT_EQ(printed_,
            "contacts of cube and far at t = 0.01 s: none: the boxes of both blocks are farther apart than "
            "they can "
            "move in a step\n");
}

TEST_F(ContactReport, NamesOfNoBlocksAreBadInput) {
  write_cube_on_slab();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"cube,sphere", "--explain-contacts cube,sphere: error: there is no block 'sphere'"},
      {"cube", "there is no comma"},
      {"cube,cube", "both names are of the same block"},
      {",", "there is no block ''"}};
  for (const auto& [names, fault] : cases) {
    EXPECT_EQ(run("out", {"--explain-contacts", names}), 2) << names;
    EXPECT_NE(faults_.find(fault), std::string::npos) << faults_;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
}

}  // namespace
}  // namespace ashlar::contact_report_test

// analysis.gravity_history as users write it, and runs under it.
#include <gmock/gmock.h>

#include "apps/scene/json/scene_json.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/run_fixture.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::gravity_history_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string with_history(const std::string& rows) {
  return sample_with(3, "time_step = 0.01\ngravity_history = " + rows);
}

TEST(GravityHistoryKey, RowsAreRead) {
  Diagnostics diagnostics;
  const Scene scene =
      parse_scene(with_history("[[0, 0, 0, -9.81], [2, 1, 2, -3]]"), "s.toml", {}, diagnostics);
  EXPECT_THAT(printed(diagnostics), IsEmpty());
  ASSERT_EQ(scene.analysis.gravity_history.size(), 2U);
  EXPECT_EQ(scene.analysis.gravity_history[1].time, 2.0);
  EXPECT_EQ(scene.analysis.gravity_history[1].value, Vector3(1, 2, -3));
  const nlohmann::json json = to_json(scene)["analysis"];
  EXPECT_FALSE(json.contains("gravity"));
  EXPECT_EQ(json["gravity_history"],
            nlohmann::json::parse("[[0.0, 0.0, 0.0, -9.81], [2.0, 1.0, 2.0, -3.0]]"));
}

TEST(GravityHistoryKey, FaultsHaveTheirPlace) {
  EXPECT_THAT(reading_faults(with_history("[[0, 0, -9.81]]")),
              ElementsAre(StartsWith("s.toml:4:20: error: gravity_history has the wrong length (3 entries), "
                                     "[t, gx, gy, gz]")));
  EXPECT_THAT(reading_faults(with_history("[[1, 0, 0, 0], [1, 0, 0, 1]]")),
              ElementsAre(StartsWith("s.toml:4:34: error: time in gravity_history does not increase (1 after "
                                     "1)")));
  EXPECT_THAT(reading_faults(with_history("[[0, 0, 0, inf]]")), ElementsAre(HasSubstr("not finite (inf)")));
  EXPECT_THAT(reading_faults(with_history("{ file = \"g.csv\", time = \"t\" }")),
              ElementsAre(HasSubstr("missing key (values), analysis.gravity_history needs it")));
}

TEST(GravityHistoryKey, StaticsThatFollowItNeedTimes) {
  const std::vector<std::string> statics = {"analysis.type=static"};
  EXPECT_THAT(reading_faults(sample_with(2, ""), statics), IsEmpty());
  EXPECT_THAT(reading_faults(sample_with(2, "gravity_history = [[0, 0, 0, -9.81]]"), statics),
              ElementsAre(HasSubstr("missing key (end_time), analysis needs it")));
}

// A cube in the air.
std::string stone(const std::string& gravity) {
  return "[analysis]\nend_time = 0.2\ntime_step = 0.01\n" + gravity + R"(
[[material]]
name = "rock"
density = 2500
young_modulus = 1e10
poisson_ratio = 0.2
[[block]]
name = "stone"
material = "rock"
box = { min = [0, 0, 0], max = [1, 1, 1] }
[[measure]]
name = "corner"
block = "stone"
point = [0, 0, 0]
)";
}

TEST_F(RunCommand, GravityFollowsAFile) {
  write_text(folder_ / "g.csv", "t;up;across\n0;-1;0\n0.1;-1;0.5\n0.2;-1;0\n");
  write_text(scene_, stone("gravity_history = { file = \"g.csv\", time = \"t\", values = [\"across\", \"\", "
                           "\"up\"], scale = 10 }"));
  ASSERT_EQ(run("out"), 0) << faults_;
  const std::vector<double> t = column("out/history.csv", "time");
  const std::vector<double> vx = column("out/history.csv", "corner.vx");
  const std::vector<double> vy = column("out/history.csv", "corner.vy");
  const std::vector<double> vz = column("out/history.csv", "corner.vz");
  ASSERT_EQ(t.size(), 21U);
  // A dda step takes gravity at its end.
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double across = t[k] <= 0.1 ? 50.0 * t[k] : 50.0 * (0.2 - t[k]);
    EXPECT_NEAR((vx[k] - vx[k - 1]) / 0.01, across, 1e-9);
    EXPECT_NEAR((vz[k] - vz[k - 1]) / 0.01, -10.0, 1e-9);
    EXPECT_NEAR(vy[k], 0.0, 1e-12);
  }
  const double kinetic = 0.5 * 2500.0 * (vx.back() * vx.back() + vz.back() * vz.back());
  EXPECT_NEAR(column("out/history.csv", "energy.applied").back() / kinetic, 1.0, 1e-10);
  EXPECT_EQ(column("out/history.csv", "energy.gravity").back(), 0.0);
  EXPECT_THAT(text("out/summary.json"), HasSubstr("g.csv"));
}

TEST_F(RunCommand, GoesOnUnderGravityThatChanges) {
  write_text(folder_ / "g.csv", "t,g\n0,-9\n0.2,-1\n");
  write_text(scene_,
             stone("gravity_history = { file = \"g.csv\", time = \"t\", values = [\"\", \"\", \"g\"] }"));
  ASSERT_EQ(run("straight"), 0) << faults_;
  ASSERT_EQ(run("parts", {"--set", "analysis.end_time=0.07"}), 0) << faults_;
  ASSERT_EQ(run("parts", {"--resume"}), 0) << faults_;
  expect_same_results("straight", "parts");
  // Another record is another scene.
  write_text(folder_ / "g.csv", "t,g\n0,-9\n0.2,-2\n");
  EXPECT_EQ(run("parts", {"--resume"}), 2);
  EXPECT_THAT(faults_, HasSubstr("checkpoint of another scene"));
}

}  // namespace
}  // namespace ashlar::test::gravity_history_test

#include "apps/scene/read/history_reader.hpp"

#include <gmock/gmock.h>

#include "apps/scene/json/scene_json.hpp"
#include "support/temporary_folder.hpp"
#include "unit/apps/sample_scene.hpp"

namespace ashlar::test::history_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Rows 0, 1 and 4 m/s^2 at 0, 1 and 2 s, by two columns without names; line 23 of the sample is a support's key.
class HistoryOfAFile : public ::testing::Test {
 protected:
  void read(const std::string& history, const std::string& key = "acceleration_history") {
    write_text(folder_ / "r.txt", "0 0\n1 1\n2 4\n");
    write_text(folder_ / "r.V2", "2 points of accel data equally spaced at 1 sec\n     1.000     2.000\n");
    diagnostics_ = {};
    scene_ = parse_scene(sample_with(23, key + " = " + history + "\n[[block.load]]"), folder_ / "s.toml", {},
                         diagnostics_);
    faults_ = {};
    for (Diagnostic fault : diagnostics_.sorted()) {
      fault.place.origin = "s.toml";
      faults_.push_back(to_string(fault));
    }
  }

  /// x of each row.
  [[nodiscard]] std::vector<double> values() const {
    std::vector<double> result;
    for (const SceneFix::Motion& row : scene_.block[1].fix[0].history) result.push_back(row.value.x());
    return result;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  Scene scene_;
  std::vector<std::string> faults_;
};

TEST_F(HistoryOfAFile, InGWithoutNames) {
  read("{ file = \"r.txt\", values = [\"a\", \"\", \"\"], scale = \"g\" }");
  EXPECT_THAT(faults_, IsEmpty());
  EXPECT_THAT(values(), ElementsAre(0.0, 9.80665, 4 * 9.80665));
}

TEST_F(HistoryOfAFile, BaselineThenRowsAtEqualIntervals) {
  // The mean 5/3 is removed, then rows lie half-way too.
  read("{ file = \"r.txt\", values = [\"a\", \"\", \"\"], baseline = 0, resample = 0.5 }");
  EXPECT_THAT(faults_, IsEmpty());
  const std::vector<double> expected = {-5.0 / 3, -7.0 / 6, -2.0 / 3, 5.0 / 6, 7.0 / 3};
  ASSERT_EQ(values().size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(values()[k], expected[k], 1e-14);
  const nlohmann::json json = to_json(scene_).at("block").at(1).at("fix").at(0).at("acceleration_history");
  EXPECT_EQ(json.at("baseline"), 0);
  EXPECT_EQ(json.at("resample"), 0.5);
  EXPECT_FALSE(json.contains("time"));
}

TEST_F(HistoryOfAFile, FaultsHaveTheirPlace) {
  read("{ file = \"r.txt\", values = [\"a\", \"\", \"\"], baseline = 3 }");
  EXPECT_THAT(faults_,
              ElementsAre("s.toml:23:77: error: record is too short for its baseline (3 rows), more than 3 "
                          "are needed"));
  read("{ file = \"r.txt\", values = [\"a\", \"\", \"\"], baseline = 0 }", "velocity_history");
  EXPECT_THAT(faults_,
              ElementsAre("s.toml:23:62: error: baseline of a history that is none of accelerations (0), it "
                          "belongs to acceleration_history"));
  read("{ file = \"r.txt\", values = [\"a\", \"\", \"\"], resample = 1e-7 }");
  EXPECT_THAT(faults_,
              ElementsAre("s.toml:23:77: error: resample makes too many rows (2 s every 1e-07 s), at least "
                          "1e-06 s is needed"));
  read("{ file = \"r.V2\", values = [\"acceleration\", \"\", \"\"], scale = \"g\" }");
  EXPECT_THAT(faults_,
              ElementsAre("s.toml:23:84: error: scale of a v2 record is not \"g\": its values are in cm/s^2, "
                          "scale = 0.01 is needed"));
}

}  // namespace
}  // namespace ashlar::test::history_reader_test

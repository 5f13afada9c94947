#include "apps/study_command.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "apps/study.hpp"
#include "apps/sub_face_study.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar {
namespace {

TEST(StudyCommand, UnknownNamesAreRefused) {
  std::ostringstream out, err;
  EXPECT_EQ(study_command({"subface", {}}, out, err), exit_status::bad_input);
  EXPECT_NE(err.str().find("did you mean subfaces?"), std::string::npos);
}

TEST(StudyCommand, WritesTableAndPicture) {
  const TemporaryFolder folder;
  std::ostringstream out, err;
  EXPECT_EQ(study_command({"subfaces", folder.path() / "s"}, out, err), exit_status::done);
  std::ifstream table(folder.path() / "s" / "subfaces.csv");
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line, "order,tolerance,sub_faces,chord_error,chord_bound,ratio,seconds");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "s" / "subfaces.svg"));
}

TEST(SubFaceStudy, BoundsHoldAndMeetTheTolerance) {
  const StudyResult result = study_sub_faces();
  EXPECT_TRUE(result.holds);
  for (const auto& row : result.rows) {
    EXPECT_LE(row[4], row[1]);  // bound, tolerance
    EXPECT_GE(row[4], row[3]);  // bound, error
  }
}

TEST(Study, TablesAreAligned) {
  StudyResult result;
  result.columns = {"n", "error"};
  result.rows = {{1, 0.25}, {10, 1e-9}};
  EXPECT_EQ(table_text(result), " n  error  \n 1   0.25  \n10  1e-09  \n");
  EXPECT_EQ(table_csv(result), "n,error\n1,0.25\n10,1e-09\n");
}

}  // namespace
}  // namespace ashlar

#include "apps/program/study/study_command.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "apps/program/study/orders_study.hpp"
#include "apps/program/study/study.hpp"
#include "benchmarks/studies/conditioning_study.hpp"
#include "benchmarks/studies/stability_study.hpp"
#include "benchmarks/studies/studies.hpp"
#include "benchmarks/studies/sub_face_study.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::study_command_test {
namespace {

TEST(StudyCommand, UnknownNamesAreRefused) {
  std::ostringstream out, err;
  EXPECT_EQ(study_command({"subface", {}}, developer_studies(), out, err), exit_status::bad_input);
  EXPECT_NE(err.str().find("did you mean subfaces?"), std::string::npos);
}

TEST(StudyCommand, AFolderThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  write_text(folder / "file", "in the way");
  std::ostringstream out, err;
  EXPECT_EQ(study_command({"conditioning", folder / "file"}, developer_studies(), out, err),
            exit_status::bad_input);
  EXPECT_EQ(err.str(), "ashlar: error: cannot create the result folder " + (folder / "file").string() +
                           ": Not a directory\n");
}

TEST(StudyCommand, WritesTableAndPicture) {
  const TemporaryFolder folder;
  std::ostringstream out, err;
  EXPECT_EQ(study_command({"subfaces", folder.path() / "s"}, developer_studies(), out, err),
            exit_status::done);
  std::ifstream table(folder.path() / "s" / "subfaces.csv");
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line, "order,tolerance,sub_faces,chord_error,chord_bound,ratio,seconds");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "s" / "subfaces.py"));
  if (out.str().find("no picture: ") != std::string::npos) GTEST_SKIP() << out.str();
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "s" / "subfaces.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "s" / "subfaces.png"));
}

TEST(SubFaceStudy, BoundsHoldAndMeetTheTolerance) {
  const StudyResult result = study_sub_faces();
  EXPECT_TRUE(result.holds);
  for (const auto& row : result.rows) {
    EXPECT_LE(row[4], row[1]);  // bound, tolerance
    EXPECT_GE(row[4], row[3]);  // bound, error
  }
}

TEST(OrdersStudy, ASmoothFieldConvergesExponentiallyAClampedOneDoesNot) {
  const StudyResult result = study_orders_to(6);
  ASSERT_EQ(result.rows.size(), 12U);
  for (std::size_t k = 1; k < 6; ++k) EXPECT_LT(result.rows[k][3], result.rows[k - 1][3]);
  // Ratios of successive errors of the smooth field fall; those of the cantilever do not go below a third.
  for (std::size_t k = 8; k < 12; ++k) {
    EXPECT_LT(result.rows[k][3] / result.rows[k - 1][3], 0.3);
    EXPECT_LT(result.rows[k][3] / result.rows[k - 1][3], result.rows[k - 1][3] / result.rows[k - 2][3]);
  }
  EXPECT_GT(result.rows[5][3] / result.rows[4][3], 1.0 / 3.0);
}

TEST(ConditioningStudy, TheOrthonormalBasisLosesLittleAnywhere) {
  const StudyResult result = study_conditioning_to(4);
  ASSERT_EQ(result.rows.size(), 48U);
  for (const auto& row : result.rows) {
    if (row[0] == 3.0) {
      EXPECT_EQ(row[3], 1.0);
      EXPECT_LT(row[5], row[1] < 1000.0 ? 6.0 : 8.0);
    }
    // The Gram matrix of monomials reaches 1e15 at n = 3, ten half-widths off the origin (theory of record).
    if (row[0] == 0.0 && row[1] == 10.0 && row[2] == 3.0) {
      EXPECT_GT(row[3], 1e12);
    }
  }
}

TEST(StabilityStudy, BlocksFarFromTheOrdinaryAreWhatIsPromised) {
  const StudyResult result = study_stability_of({{1, 2}, 4, 2.5e-3});
  EXPECT_TRUE(result.holds);
  for (const std::string& finding : result.findings)
    EXPECT_EQ(finding.find("NOT"), std::string::npos) << finding;
  for (const auto& row : result.rows) {
    EXPECT_EQ(row[8], 1.0) << "sweep " << row[0] << ", value " << row[1];
    EXPECT_LE(row[4], row[9]) << "sweep " << row[0] << ", value " << row[1];
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
}  // namespace ashlar::study_command_test

// Spectra from tables.
#include "apps/scene/records/spectrum_file.hpp"

#include <gmock/gmock.h>

#include "support/temporary_folder.hpp"

namespace ashlar::spectrum_file_test {
namespace {

class SpectrumFile : public ::testing::Test {
 protected:
  std::optional<std::vector<SceneSpectrum::Point>> read(const std::string& text, double scale = 1.0) {
    write_text(folder_ / "s.csv", text);
    Diagnostics diagnostics;
    auto points = read_spectrum("s.csv", scale, folder_ / "", {"s.toml", 1, 1}, diagnostics);
    faults_.clear();
    for (const Diagnostic& fault : diagnostics.sorted()) faults_ += to_string(fault) + '\n';
    return points;
  }

  TemporaryFolder folder_;
  std::string faults_;
};

TEST_F(SpectrumFile, HasTheColumnsOfTheCommand) {
  const auto points = read("period,displacement,pseudo_velocity,pseudo_acceleration\n0.1,9,9,2\n0.5,9,9,6\n");
  ASSERT_TRUE(points) << faults_;
  ASSERT_EQ(points->size(), 2U);
  EXPECT_EQ((*points)[1].period, 0.5);
  EXPECT_EQ((*points)[1].acceleration, 6.0);
}

TEST_F(SpectrumFile, ReadsTwoColumnsWithAndWithoutNames) {
  for (const char* head : {"T,Sa\n", "", "# a comment\n"}) {
    const auto points = read(std::string(head) + "0, 0.25\n0.2, 0.6\n", 9.81);
    ASSERT_TRUE(points) << head << faults_;
    EXPECT_EQ((*points)[0].period, 0.0);
    EXPECT_DOUBLE_EQ((*points)[1].acceleration, 0.6 * 9.81);
  }
}

TEST_F(SpectrumFile, RefusesWhatIsNoSpectrum) {
  EXPECT_FALSE(read("T,Sa\n0.2,1\n0.1,1\n"));
  EXPECT_THAT(faults_, ::testing::HasSubstr("does not increase"));
  EXPECT_FALSE(read("T,Sa\n0.2,-1\n"));
  EXPECT_THAT(faults_, ::testing::HasSubstr("negative"));
  EXPECT_FALSE(read("T\n0.2\n"));
  EXPECT_FALSE(faults_.empty());
}

}  // namespace
}  // namespace ashlar::spectrum_file_test

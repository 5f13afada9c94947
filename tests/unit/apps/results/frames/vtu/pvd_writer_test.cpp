#include "apps/results/frames/vtu/pvd_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "support/temporary_folder.hpp"

namespace ashlar::pvd_writer_test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kEnd = "  </Collection>\n</VTKFile>\n";

TEST(PvdWriter, IsCompleteAfterEachFrame) {
  const TemporaryFolder folder;
  PvdWriter series(folder / "blocks.pvd");
  EXPECT_THAT(read_text(folder / "blocks.pvd"), AllOf(Not(HasSubstr("<DataSet")), EndsWith(kEnd)));
  series.add_frame(0.0, "blocks/0.vtu");
  EXPECT_THAT(read_text(folder / "blocks.pvd"),
              AllOf(HasSubstr(R"(<DataSet timestep="0" part="0" file="blocks/0.vtu"/>)"), EndsWith(kEnd)));
  series.add_frame(0.1 + 0.2, "blocks/1.vtu");
  EXPECT_THAT(read_text(folder / "blocks.pvd"),
              AllOf(HasSubstr("blocks/0.vtu"), EndsWith(kEnd),
                    HasSubstr(R"(timestep="0.30000000000000004" part="0" file="blocks/1.vtu"/>)")));
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(PvdWriter, GoesOnWithTheFramesOfAnEarlierRun) {
  const TemporaryFolder folder;
  PvdWriter first(folder / "blocks.pvd");
  first.add_frame(0.0, "0.vtu");
  first.add_frame(1.0, "1.vtu");
  const std::string whole = read_text(folder / "blocks.pvd");
  PvdWriter second(folder / "blocks.pvd", {first.frames().front()});
  EXPECT_THAT(read_text(folder / "blocks.pvd"), AllOf(HasSubstr("0.vtu"), Not(HasSubstr("1.vtu"))));
  second.add_frame(1.0, "1.vtu");
  EXPECT_EQ(read_text(folder / "blocks.pvd"), whole);
}

TEST(PvdWriter, EscapesFileNames) {
  const TemporaryFolder folder;
  PvdWriter(folder / "a.pvd").add_frame(0.0, "R&D \"<1>\".vtu");
  EXPECT_THAT(read_text(folder / "a.pvd"), HasSubstr("file=\"R&amp;D &quot;&lt;1&gt;&quot;.vtu\""));
}

TEST(PvdWriter, ReportsAFolderThatIsGone) {
  const TemporaryFolder folder;
  EXPECT_THROW(PvdWriter(folder / "none/a.pvd"), std::runtime_error);
}

}  // namespace
}  // namespace ashlar::pvd_writer_test

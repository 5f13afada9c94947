#include "apps/results/tables/history_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace ashlar::history_writer_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<std::string> kColumns = {"step", "time", "tip.uz"};
constexpr const char* kTable = "step,time,tip.uz\n1,0.1,-1\n2,0.2,-2\n3,0.3,-3\n";

void append(HistoryWriter& history, std::int64_t step, double time, double value) {
  history.append(step, std::array{time, value});
}

TEST(HistoryWriter, HasEachRowInTheFileAtOnce) {
  const TemporaryFolder folder;
  HistoryWriter history(folder / "history.csv", kColumns);
  EXPECT_EQ(read_text(folder / "history.csv"), "step,time,tip.uz\n");
  append(history, 1, 0.1, -0.25);
  EXPECT_EQ(read_text(folder / "history.csv"), "step,time,tip.uz\n1,0.1,-0.25\n");
  append(history, 3000000, 1e-9, 0.30000000000000004);
  EXPECT_EQ(read_text(folder / "history.csv"),
            "step,time,tip.uz\n1,0.1,-0.25\n3000000,1e-09,0.30000000000000004\n");
}

TEST(HistoryWriter, EmptiesAnOldFile) {
  const TemporaryFolder folder;
  write_text(folder / "history.csv", kTable);
  const HistoryWriter history(folder / "history.csv", kColumns);
  EXPECT_EQ(read_text(folder / "history.csv"), "step,time,tip.uz\n");
}

TEST(HistoryWriter, QuotesColumnNames) {
  const TemporaryFolder folder;
  const std::vector<std::string> columns = {"step", "a,b.ux"};
  HistoryWriter(folder / "history.csv", columns).append(1, std::array{2.0});
  EXPECT_EQ(read_text(folder / "history.csv"), "step,\"a,b.ux\"\n1,2\n");
  HistoryWriter::resume(folder / "history.csv", columns, 1).append(2, std::array{3.0});
  EXPECT_EQ(read_text(folder / "history.csv"), "step,\"a,b.ux\"\n1,2\n2,3\n");
}

TEST(HistoryWriter, RefusesRowsOfAnotherLength) {
  const TemporaryFolder folder;
  HistoryWriter history(folder / "history.csv", kColumns);
  EXPECT_THROW(history.append(1, std::array{0.1}), std::invalid_argument);
  EXPECT_THROW(history.append(1, std::array{0.1, 0.2, 0.3}), std::invalid_argument);
  EXPECT_THROW(HistoryWriter(folder / "none.csv", {}), std::invalid_argument);
  EXPECT_EQ(read_text(folder / "history.csv"), "step,time,tip.uz\n");
}

TEST(HistoryWriterResume, DropsTheRowsAfterTheStep) {
  const TemporaryFolder folder;
  write_text(folder / "history.csv", kTable);
  HistoryWriter history = HistoryWriter::resume(folder / "history.csv", kColumns, 2);
  EXPECT_EQ(read_text(folder / "history.csv"), "step,time,tip.uz\n1,0.1,-1\n2,0.2,-2\n");
  append(history, 3, 0.3, 7.0);
  EXPECT_EQ(read_text(folder / "history.csv"), "step,time,tip.uz\n1,0.1,-1\n2,0.2,-2\n3,0.3,7\n");
}

TEST(HistoryWriterResume, KeepsEverythingUpToTheLastRow) {
  const TemporaryFolder folder;
  write_text(folder / "history.csv", kTable);
  const HistoryWriter history = HistoryWriter::resume(folder / "history.csv", kColumns, 3);
  EXPECT_EQ(read_text(folder / "history.csv"), kTable);
}

TEST(HistoryWriterResume, DropsALineThatWasCut) {
  const TemporaryFolder folder;
  write_text(folder / "history.csv", std::string(kTable).append("4,0."));
  const HistoryWriter history = HistoryWriter::resume(folder / "history.csv", kColumns, 3);
  EXPECT_EQ(read_text(folder / "history.csv"), kTable);
}

TEST(HistoryWriterResume, StartsFromTheHeaderAtStepZero) {
  const TemporaryFolder folder;
  write_text(folder / "history.csv", kTable);
  HistoryWriter history = HistoryWriter::resume(folder / "history.csv", kColumns, 0);
  append(history, 1, 0.5, 6.0);
  EXPECT_EQ(read_text(folder / "history.csv"), "step,time,tip.uz\n1,0.5,6\n");
}

// A refused table stays as it is: it may be the only copy of another run's result.
TEST(HistoryWriterResume, RefusesAnotherTable) {
  const TemporaryFolder folder;
  const auto path = folder / "history.csv";
  const auto resume = [&](std::int64_t step) {
    return [&path, step] { return HistoryWriter::resume(path, kColumns, step); };
  };
  EXPECT_THAT(resume(1), ThrowsMessage<std::runtime_error>(HasSubstr("history.csv: No such file")));
  write_text(path, kTable);
  EXPECT_THAT(resume(4), ThrowsMessage<std::runtime_error>(HasSubstr("end at step 3, before step 4")));
  EXPECT_EQ(read_text(path), kTable);
  write_text(path, std::string(kTable) + "4,0.");
  EXPECT_THROW(resume(4)(), std::runtime_error);
  for (const char* other : {"", "step,time\n1,0.1\n", "step,time,tip.uz,more\n1,0.1,2,3\n"}) {
    write_text(path, other);
    EXPECT_THAT(resume(1), ThrowsMessage<std::runtime_error>(HasSubstr("columns"))) << other;
    EXPECT_EQ(read_text(path), other);
  }
  write_text(path, "step,time,tip.uz\nx,0.1,2\n");
  EXPECT_THAT(resume(1), ThrowsMessage<std::runtime_error>(HasSubstr("no step number")));
}

}  // namespace
}  // namespace ashlar::history_writer_test

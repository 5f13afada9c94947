#include "apps/results/tables/history_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>

#include "apps/results/tables/history_writer.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::history_table_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(HistoryTable, ReadsWhatTheWriterWrote) {
  const TemporaryFolder folder;
  const std::vector<std::string> columns = {"step", "-a.y", "=a, \"b\".x"};
  HistoryWriter writer(folder / "h.csv", columns);
  writer.append(0, std::vector<double>{0.0, 0.1 + 0.2});
  writer.append(7, std::vector<double>{-1e-300, std::nan("")});
  const HistoryTable table = read_history(folder / "h.csv", 10);
  EXPECT_EQ(table.columns, columns);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_THAT(table.rows[0], ElementsAre(0.0, 0.0, 0.1 + 0.2));
  EXPECT_EQ(table.rows[1][0], 7.0);
  EXPECT_EQ(table.rows[1][1], -1e-300);
  EXPECT_TRUE(std::isnan(table.rows[1][2]));
}

TEST(HistoryTable, LongTablesAreThinnedEvenlyToTheirEnd) {
  const TemporaryFolder folder;
  std::string text = "step\n";
  for (int i = 0; i < 10; ++i) text += std::to_string(i) + "\n";
  write_text(folder / "h.csv", text);
  std::vector<double> steps;
  for (const auto& row : read_history(folder / "h.csv", 4).rows) steps.push_back(row[0]);
  EXPECT_THAT(steps, ElementsAre(0, 4, 8, 9));
}

TEST(HistoryTable, ACutLastLineIsNotRead) {
  const TemporaryFolder folder;
  write_text(folder / "h.csv", "step,time\n0,0\n1,0.");
  EXPECT_EQ(read_history(folder / "h.csv", 4).rows.size(), 1U);
}

TEST(HistoryTable, APipeIsNotWaitedFor) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "h.csv").c_str(), 0600), 0);
  EXPECT_THAT([&] { (void)read_history(folder / "h.csv", 4); },
              ThrowsMessage<std::runtime_error>(HasSubstr("h.csv: it is not a regular file")));
}

TEST(HistoryTable, FaultsNameTheLine) {
  const TemporaryFolder folder;
  for (const char* row : {"1", "1,2,3", "1,x", "1,", ""}) {
    write_text(folder / "h.csv", std::string("step,time\n0,0\n") + row + "\n");
    EXPECT_THAT([&] { (void)read_history(folder / "h.csv", 4); },
                ThrowsMessage<std::runtime_error>(HasSubstr("line 3 ")))
        << row;
  }
  EXPECT_THAT([&] { (void)read_history(folder / "none.csv", 4); },
              ThrowsMessage<std::runtime_error>(HasSubstr("none.csv: it cannot be opened")));
}

}  // namespace
}  // namespace ashlar::history_table_test

#include "apps/scene/records/sampled_record.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "apps/scene/records/record_file.hpp"

namespace ashlar::sampled_record_test {
namespace {

using Rows = std::vector<std::vector<double>>;

struct Read {
  std::optional<Rows> rows;
  std::string faults;
};

Read read(const std::string& name, const std::string& content, std::vector<std::string> values,
          double scale = 0.01, const std::string& time = "") {
  SceneRecord record;
  record.time = time;
  record.values = std::move(values);
  record.scale = scale;
  std::istringstream stream(content);
  Diagnostics diagnostics;
  Read result{parse_record(record, stream, name, diagnostics), ""};
  for (const Diagnostic& one : diagnostics.sorted()) result.faults += to_string(one) + "\n";
  return result;
}

// Two channels, values of ten columns that touch each other.
const std::string channel_1 =
    "Corrected accelerogram\n"
    "  10 points of accel data equally spaced at  .020 sec, in cm/sec2.   (8f10.3)\n"
    "  -100.000-200.000   300.000   400.000   500.000   600.000   700.000   800.000\r\n"
    "   900.000  1000.000\n"
    "  2 points of veloc data equally spaced at  .500 sec, in cm/sec.\n"
    "     1.000     2.000\n"
    "/&  ----------  End of data for channel  1  ----------\n";
const std::string channel_2 =
    "  10 POINTS OF ACCEL DATA EQUALLY SPACED AT .02 SEC. (5F12.4)\n"
    "      1.0000      2.0000      3.0000      4.0000      5.0000\n"
    "      6.0000      7.0000      8.0000      9.0000     10.0000\n";

TEST(SampledRecord, Volume2HasSeriesByQuantityAndChannel) {
  std::string touching = channel_1;
  touching.replace(touching.find("  -100.000-200.000"), 18, "  -100.000  -200.000");
  const Read found = read("RECORD.V2", touching + channel_2, {"acceleration", "", "acceleration.2"});
  ASSERT_TRUE(found.rows) << found.faults;
  ASSERT_EQ(found.rows->size(), 10U);
  EXPECT_EQ((*found.rows)[1], (std::vector<double>{0.02, -2.0, 0.0, 0.02}));
  EXPECT_EQ((*found.rows)[9], (std::vector<double>{9 * 0.02, 10.0, 0.0, 0.1}));
  const Read velocity = read("record.v2", touching, {"velocity", "", ""});
  ASSERT_TRUE(velocity.rows) << velocity.faults;
  EXPECT_EQ(*velocity.rows, (Rows{{0.0, 0.01, 0.0, 0.0}, {0.5, 0.02, 0.0, 0.0}}));
}

TEST(SampledRecord, Volume2FieldsOfFixedWidthTouch) {
  const Read found =
      read("a.V2", "2 points of accel data equally spaced at .5 sec, in cm/sec2\n-10000.000-20000.000\n",
           {"acceleration"});
  ASSERT_TRUE(found.rows) << found.faults;
  EXPECT_EQ(*found.rows, (Rows{{0.0, -100.0}, {0.5, -200.0}}));
}

TEST(SampledRecord, FaultsOfVolume2HaveTheirPlace) {
  const std::string head = "3 points of accel data equally spaced at .5 sec, in cm/sec2\n";
  const auto faults = [](const std::string& content, const std::string& name = "acceleration") {
    return read("a.V2", content, {name}).faults;
  };
  EXPECT_EQ(faults(head + "     1.000     2.000\n"),
            "a.V2:2:1: error: record has 2 values; its head says 3\n");
  EXPECT_EQ(faults(head + "     1.000     2.000     3.000     4.000\n"),
            "a.V2:2:1: error: record has more values than its head says (3)\n");
  EXPECT_EQ(faults(head + "     1.000     2.000     3.000\n\n     4.000\n"),
            "a.V2:4:1: error: record has more values than its head says (3)\n");
  EXPECT_EQ(
      faults(head + "     1.000      2.x0     3.000\n"),
      "a.V2:2:11: error: no number (\"2.x0\") after 1 of the 3 values of the head; a finite number in 10 "
      "columns is needed\n");
  EXPECT_EQ(faults(head + "     1.000     2.000     3.000\n", "a"),
            "a.V2:2:1: error: record has no series \"a\"; one of \"acceleration\" is needed\n");
  EXPECT_EQ(
      faults("0 points of accel data equally spaced at .5 sec\n"),
      "a.V2:1:1: error: line before a series has no number of values or no interval; \"N points of accel "
      "data equally spaced at DT sec\" is needed\n");
  for (const char* layout : {"(99999999999999999999f10.3)", "(8f9223372036854775808.3)", "(8f10001)"})
    EXPECT_EQ(
        faults("3 points of accel data equally spaced at .5 sec, in cm/sec2. " + std::string(layout) +
               "\n     1.000     2.000     3.000\n"),
        "a.V2:1:1: error: line before a series has a layout that is too wide; at most 10000 values of 10000 "
        "columns, as (8f10.3), are allowed\n")
        << layout;
  EXPECT_EQ(
      faults("text\n"),
      "a.V2:1:1: error: volume 2 record has no series; a line \"N points of accel data equally spaced at DT "
      "sec\" and its values are needed\n");
}

/// @param count, comments, rate of the head
std::string smc_head(int count, int comments, double rate,
                     const std::string& kind = "2 CORRECTED ACCELEROGRAM") {
  std::string text = kind + "\n";
  for (int k = 1; k < 11; ++k) text += "*\n";
  for (int k = 0; k < 48; ++k)
    text += fmt::format("{:10d}{}", k == 15 ? comments : k == 16 ? count : -32768, k % 8 == 7 ? "\n" : "");
  for (int k = 0; k < 50; ++k)
    text += fmt::format("{:15.7E}{}", k == 1 ? rate : 1.7e38, k % 5 == 4 ? "\n" : "");
  for (int k = 0; k < comments; ++k) text += "| comment\n";
  return text;
}

TEST(SampledRecord, SmcHasOneSeries) {
  const Read low = read("a.smc",
                        smc_head(9, 2, 200.0) +
                            " 1.0000E+0-2.0000E+0 3.0000E+0 4.0000E+0 5.0000E+0 6.0000E+0 7.0000E+0"
                            " 8.0000E+0\n 9.0000E+0\n",
                        {"a", "", ""});
  ASSERT_TRUE(low.rows) << low.faults;
  ASSERT_EQ(low.rows->size(), 9U);
  EXPECT_EQ((*low.rows)[1], (std::vector<double>{1.0 / 200.0, -0.02, 0.0, 0.0}));
  const Read high = read("a.SMC", smc_head(2, 0, 2.0) + " 1.0000000E+02-2.0000000E+02\n", {"a"});
  ASSERT_TRUE(high.rows) << high.faults;
  EXPECT_EQ(*high.rows, (Rows{{0.0, 1.0}, {0.5, -2.0}}));
}

TEST(SampledRecord, FaultsOfSmcHaveTheirPlace) {
  const auto faults = [](const std::string& content) { return read("a.smc", content, {"a"}).faults; };
  EXPECT_EQ(faults(smc_head(3, 1, 100.0) + " 1.0000E+0 2.0000E+0\n"),
            "a.smc:29:1: error: record has 2 values; its head says 3\n");
  EXPECT_EQ(faults(smc_head(1, 0, 100.0) + " 1.0000E+0\n 2.0000E+0\n"),
            "a.smc:29:1: error: record goes on after the values that its head says (1)\n");
  EXPECT_EQ(
      faults(smc_head(1, 0, 100.0, "5 RESPONSE SPECTRA")),
      "a.smc:1:1: error: no motion in time in the first line of an SMC record; a line like \"2 CORRECTED "
      "ACCELEROGRAM\", of kinds 0 to 4, is needed\n");
  EXPECT_EQ(faults("2 CORRECTED ACCELEROGRAM\n"),
            "a.smc:1:1: error: SMC record ends in its head; 11 lines of text, 6 and 10 lines of numbers are "
            "needed\n");
  EXPECT_EQ(
      faults(smc_head(0, 0, 100.0)),
      "a.smc:27:1: error: head of the SMC record has no number of values (0, the 17th whole number) or no "
      "values in a second (100, the second number); both are needed\n");
}

TEST(RecordFile, ColumnsWithoutNamesAreNamedByTheirNumbers) {
  const Rows expected{{0.0, 2.0}, {0.5, -4.0}};
  for (const char* text :
       {"0 1\n0.5 -2\n", "  0\t 1\n 0.5 \t-2\n", "# a comment\n0, 1\n0.5,-2\n", "0;1\n.5;-2\n"}) {
    const Read found = read("a.txt", text, {"a"}, 2.0);
    ASSERT_TRUE(found.rows) << found.faults;
    EXPECT_EQ(*found.rows, expected) << text;
  }
  const Read three = read("a.csv", "0,1,7\n0.5,-2,8\n", {"3", "", "2"}, 2.0, "t");
  ASSERT_TRUE(three.rows) << three.faults;
  EXPECT_EQ(*three.rows, (Rows{{0.0, 14.0, 0.0, 2.0}, {0.5, 16.0, 0.0, -4.0}}));
  EXPECT_EQ(read("a.csv", "0,1,7\n", {"a"}).faults,
            "a.csv:1:1: error: record has 3 columns without names, none is \"a\"; a number from 1 to 3 is "
            "needed\n");
  EXPECT_EQ(read("a.csv", "0 1\n0.5\n", {"a"}).faults,
            "a.csv:2:4: error: row has 1 fields, at least 2 are needed\n");
  EXPECT_EQ(
      read("a.csv", "t,a\n0,1\n", {"a"}).faults,
      "a.csv:1:1: error: record has a line of column names (t, a); time, the name of its column of times, is "
      "needed\n");
}

}  // namespace
}  // namespace ashlar::sampled_record_test

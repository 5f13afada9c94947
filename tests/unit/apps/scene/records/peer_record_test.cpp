#include "apps/scene/records/peer_record.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "apps/scene/records/record_file.hpp"

namespace ashlar::peer_record_test {
namespace {

using Rows = std::vector<std::vector<double>>;

struct Read {
  std::optional<Rows> rows;
  std::string faults;
};

Read read(const std::string& content) {
  const SceneRecord record{"record.AT2", "t", {"a", "", "a"}, 2.0, ""};
  std::istringstream stream(content);
  Diagnostics diagnostics;
  Read result{parse_record(record, stream, "record.AT2", diagnostics), ""};
  for (const Diagnostic& one : diagnostics.sorted()) result.faults += to_string(one) + "\n";
  return result;
}

const std::string head =
    "PEER NGA STRONG MOTION DATABASE RECORD\nA QUAKE, 1/2/1999, STATION, 090\nIN UNITS OF G\n";

TEST(PeerRecord, ValuesFollowEachOtherInTime) {
  const Rows expected{{0.0, 0.5, 0.0, 0.5}, {0.25, -1.0, 0.0, -1.0}, {0.5, 4.0, 0.0, 4.0}};
  for (const char* counts :
       {"NPTS=      3, DT=   .2500 SEC,", "NPTS=3, DT=0.25 SEC", "    3    0.2500    NPTS, DT"}) {
    const Read found = read(head + counts + "\n  0.2500000E+00 -0.5000000E+00\r\n  .2000000E+01\r\n\n");
    ASSERT_TRUE(found.rows) << found.faults;
    EXPECT_EQ(*found.rows, expected) << counts;
  }
}

TEST(PeerRecord, FaultsHaveTheirPlace) {
  const std::string good = head + "NPTS= 3, DT= .25 SEC\n";
  EXPECT_EQ(read(head).faults,
            "record.AT2:3:1: error: PEER record ends in its head (3 lines); 4 lines and values are needed\n");
  const std::string no_head =
      "record.AT2:4:1: error: head of a PEER record has no number of values and no time step; \"NPTS= n, DT= "
      "s SEC\" is "
      "needed in its fourth line\n";
  for (const char* bad :
       {"NPTS= 3", "NPTS= 2.5, DT= 1", "NPTS= 3, DT= 0", "NPTS= 0, DT= 1", "NPTS=, DT=", "DT= 1 NPTS= 3"})
    EXPECT_EQ(read(head + bad + "\n1 2 3\n").faults, no_head) << bad;
  EXPECT_EQ(read(good + "1 2\n").faults,
            "record.AT2:5:1: error: record has 2 values; its head says NPTS = 3\n");
  EXPECT_EQ(read(good + "1 2 3\n4\n").faults,
            "record.AT2:6:1: error: record has 4 values; its head says NPTS = 3\n");
  EXPECT_EQ(read(good + "1 2 x3\n").faults,
            "record.AT2:5:5: error: no number (\"x3\"); a finite number is needed\n");
  EXPECT_EQ(read(good + "1 2 3.4.5\n").faults,
            "record.AT2:5:5: error: no number (\"3.4.5\"); a finite number is needed\n");
  EXPECT_EQ(read(good + "1 nan 3\n").faults,
            "record.AT2:5:3: error: no number (\"nan\"); a finite number is needed\n");
  EXPECT_EQ(read(good + "1 1e308 3\n").faults,
            "record.AT2:5:3: error: value times scale is not finite (1e+308 times 2); a number is needed\n");
}

}  // namespace
}  // namespace ashlar::peer_record_test

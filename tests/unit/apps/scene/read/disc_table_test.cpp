#include "apps/scene/read/disc_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace ashlar::disc_table_test {
namespace {

struct Read {
  std::optional<std::vector<MeasuredJoint>> joints;
  std::string faults;
};

Read read(const std::string& text) {
  std::istringstream content(text);
  Diagnostics diagnostics;
  Read result{parse_disc_table(content, "j.csv", diagnostics), ""};
  for (const Diagnostic& one : diagnostics.sorted()) result.faults += to_string(one) + "\n";
  return result;
}

TEST(DiscTable, ColumnsComeInAnyOrder) {
  const Read found =
      read("# seen in March\nset;radius;dip;dip_direction;z;y;x\nJ1;4;65;140;3;2;1\n\nJ2;inf;0;-10;6;5;4\n");
  ASSERT_TRUE(found.joints) << found.faults;
  ASSERT_EQ(found.joints->size(), 2U);
  const MeasuredJoint& first = found.joints->front();
  EXPECT_EQ(first.center, Vector3(1, 2, 3));
  EXPECT_EQ(first.dip, 65.0);
  EXPECT_EQ(first.dip_direction, 140.0);
  EXPECT_EQ(first.radius, 4.0);
  EXPECT_FALSE(found.joints->back().radius);
  EXPECT_EQ(found.joints->back().dip_direction, -10.0);
}

TEST(DiscTable, TheRadiusMayBeLeftOut) {
  const Read found = read("x y z dip dip_direction\n1 2 3 90 0\n");
  ASSERT_TRUE(found.joints) << found.faults;
  EXPECT_FALSE(found.joints->front().radius);
  EXPECT_TRUE(read("x,y,z,dip,dip_direction,radius\n1,2,3,90,0\n").joints);
}

TEST(DiscTable, FaultsHaveTheirPlace) {
  const std::string names = "x,y,z,dip,dip_direction,radius\n";
  EXPECT_EQ(read("x,y,z,dip\n1,2,3,4\n").faults,
            "j.csv:1:1: error: table has no column \"dip_direction\", columns x, y, z, dip, dip_direction, "
            "radius are "
            "needed (radius may be left out)\n");
  EXPECT_EQ(read(names + "1,2,3,91,0,1\n").faults,
            "j.csv:2:7: error: dip is out of range (\"91\"), a number of degrees from 0 to 90 is needed\n");
  EXPECT_EQ(read(names + "1,2,3,90,0,0\n").faults,
            "j.csv:2:12: error: radius is out of range (\"0\"), a number > 0, or inf, is needed\n");
  EXPECT_EQ(read(names + "1, north,3,90,0,1\n").faults,
            "j.csv:2:4: error: y is out of range (\"north\"), a number is needed\n");
  EXPECT_EQ(read(names + "1,2,3\n").faults, "j.csv:2:1: error: row has 3 fields, 4 are needed\n");
  EXPECT_EQ(read(names).faults, "j.csv:1:1: error: table has no joint (0 rows), at least 1 is needed\n");
  EXPECT_EQ(
      read("").faults,
      "j.csv:1:1: error: table is empty, a line of column names (x, y, z, dip, dip_direction, radius) is "
      "needed\n");
}

}  // namespace
}  // namespace ashlar::disc_table_test

#include "apps/scene/import/unblocks_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar::unblocks_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two tetrahedra, the first one fixed, bonded, with a boundary that is left out.
const std::string blocks = R"(#_DDA_DataFile_Version_1.0
POINTS_START_LENGTH 2
0 4
4 4

POINTS 8 double
0 0 0
4 0 0
0 4 0
0 0 4
0 0 -4
4 0 0
0 4 0
0 0 0

FACES_NODELIST 24
0 2 1 0 1 3 1 2 3 0 3 2
0 1 3 0 2 1 0 3 2 1 2 3

FACES 8
0 3
3 3
6 3
9 3
12 3
15 3
18 3
21 3

BLOCK_FACES 2
0 4
4 4

EDGES 2
0 1 1 2

EDGES 2
0 1
1 1

SCALARS aspectRatio float
1.2
1.2

SCALARS fixedFlag int
1
0

SCALARS volume float
10.6
10.6

/////////////Boundaries///////////
Bond: 1
0 1 0 3 3

Viscous: 1
0 2

Roller: 0
)";

TEST(UnblocksReader, ReadsBlocksSupportsAndBonds) {
  const ImportedModel model = read_unblocks(blocks);
  ASSERT_EQ(model.blocks.size(), 2U);
  EXPECT_EQ(centroid_of(model.blocks[0]), Vector3(1, 1, 1));
  EXPECT_EQ(centroid_of(model.blocks[1]), Vector3(1, 1, -1));
  EXPECT_TRUE(model.blocks[0].fixed);
  EXPECT_FALSE(model.blocks[1].fixed);
  ASSERT_EQ(model.joints.size(), 1U);
  EXPECT_EQ(model.joints[0].first, "0");
  EXPECT_EQ(model.joints[0].second, "1");
  EXPECT_TRUE(model.joints[0].tied);
  EXPECT_THAT(model.left_out, ElementsAre("1 boundaries \"Viscous\" (line 57)"));
}

struct Fault {
  std::string from, to, says;
};

TEST(UnblocksReader, RefusesFaults) {
  for (const Fault& fault :
       {Fault{"Version_1.0", "Version_2.0", "1:1: unexpected word"},
        Fault{"0 4\n4 4\n\nPOINTS", "0 4\n4 9\n\nPOINTS",
              "points 4 to 13 of a block or face, the file has 8"},
        Fault{"\n0 3\n", "\n0 2\n", "a face of block 0 has 2 corners"},
        Fault{"\n0 3\n", "\n99 3\n", "corners 99 to 102"},
        Fault{"0 2 1 0", "0 2 7 0", "a face of block 0 has corner 7, allowed are 0 to below 4"},
        Fault{"4 0 0\n", "4 0 q\n", "8:5: coordinate (q), must be a number"},
        Fault{"0 1 0 3 3", "0 5 0 3 3", "block of a bond (5), allowed 0 to 1"},
        Fault{"BLOCK_FACES 2\n0 4\n", "BLOCK_FACES 1\n", "BLOCK_FACES has 1 blocks"}}) {
    std::string text = blocks;
    text.replace(text.find(fault.from), fault.from.size(), fault.to);
    try {
      (void)read_unblocks(text);
      ADD_FAILURE() << fault.says;
    } catch (const MeshFileError& error) {
      EXPECT_THAT(fmt::format("{}:{}: {}", error.line(), error.column(), error.what()),
                  HasSubstr(fault.says));
    }
  }
}

TEST(UnblocksReader, EndsAnywhere) {
  for (std::size_t size = 0; size < blocks.size(); ++size) {
    try {
      (void)read_unblocks(std::string_view(blocks).substr(0, size));
      EXPECT_GE(size, blocks.find("BLOCK_FACES 2\n0 4\n4 4"));
    } catch (const MeshFileError& error) {
      EXPECT_STRNE(error.what(), "");
    }
  }
}

}  // namespace
}  // namespace ashlar::unblocks_reader_test

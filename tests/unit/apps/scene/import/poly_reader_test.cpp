#include "apps/scene/import/poly_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar::poly_reader_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

const std::string data = R"(; a podium, a drum and a wedge
new
poly brick 0,4 0,4 -1,0
POLY region 2 prism &
a ( 1.0, 1.0, 0.0) ( 3.0, 1.0, 0.0) ( 3.0, 3.0, 0.0)&
  ( 1.0, 3.0, 0.0)&
b ( 1.5, 1.5, 2.0) ( 2.5, 1.5, 2.0) ( 2.5, 2.5, 2.0) (1.5 2.5 2.0)  ; a frustum
poly reg 3 mat 2 face 0 0 5  1 0 5  0 1 5 face (0,0,5) (0,1,5) (0,0,6) &
  face 0 0 5  0 0 6  1 0 5   face 1 0 5 0 0 6 0 1 5
range name high z 4 10
range name drum region 2
range name both union nrange high drum
prop mat 1 dens 2500 bulk 1e9
property material=2 density=2600
prop mat 3 dens 2700
prop jmat 1 jkn 2e9 jks 1e9 jfric 35 jcoh 1e4 jdil 0
change mat 3 range nrange drum
fix range z -1 0
gravity 0 0 -10
cycle 1000
)";

TEST(PolyReader, ReadsBlocksWithTheirProperties) {
  const ImportedModel model = read_poly(data);
  ASSERT_EQ(model.blocks.size(), 3U);
  EXPECT_EQ(model.blocks[0].name, "1");
  EXPECT_EQ(model.blocks[1].name, "r2_2");
  EXPECT_EQ(model.blocks[2].name, "r3_3");
  EXPECT_EQ(centroid_of(model.blocks[0]), Vector3(2, 2, -0.5));
  // A frustum of squares of 2 m and 1 m: its centroid is at h/4 (A1 + 2 sqrt(A1 A2) + 3 A2) / (A1 + sqrt(A1 A2) + A2).
  EXPECT_LT((centroid_of(model.blocks[1]) - Vector3(2, 2, 0.5 * 11.0 / 7.0)).norm(), 1e-14);
  EXPECT_EQ(centroid_of(model.blocks[2]), Vector3(0.25, 0.25, 5.25));
  EXPECT_EQ(model.blocks[2].points.size(), 4U);
  EXPECT_TRUE(model.blocks[0].fixed);
  EXPECT_FALSE(model.blocks[1].fixed);
  const auto density = [&](std::size_t k) { return *model.materials[*model.blocks[k].material].density; };
  EXPECT_EQ(density(0), 2500.0);
  EXPECT_EQ(density(1), 2700.0);
  EXPECT_EQ(density(2), 2600.0);
  EXPECT_EQ(model.contact, (ImportedLaw{35.0, 1e4, std::nullopt, 2e9, 1e9}));
  EXPECT_EQ(*model.gravity, Vector3(0, 0, -10));
  EXPECT_EQ(model.rounding, 0.0);
  EXPECT_THAT(model.left_out, UnorderedElementsAre("command new (once)", "command cycle (once)",
                                                   "command property mat bulk (once)"));
}

TEST(PolyReader, RangesOfRanges) {
  const ImportedModel model = read_poly(data + "fix range nrange both\n");
  EXPECT_TRUE(model.blocks[1].fixed);
  EXPECT_TRUE(model.blocks[2].fixed);
  const ImportedModel all =
      read_poly("poly brick 0 1 0 1 0 1\npoly brick 1 2 0 1 0 1\nfix range x 0 1 z 0 1\n");
  EXPECT_TRUE(all.blocks[0].fixed);
  EXPECT_FALSE(all.blocks[1].fixed);
  EXPECT_TRUE(read_poly("poly brick 0 1 0 1 0 1\nfix").blocks[0].fixed);
}

TEST(PolyReader, DecimalsTellTheRounding) {
  EXPECT_DOUBLE_EQ(
      read_poly("poly brick 0 1 0 1 0 1\npoly prism a 0 0 1.00000 1 0 1 0 1 1 b 0 0 2 1 0 2 0 1 2.5")
          .rounding,
      0.5e-5);
}

std::string refusal(const std::string& text) {
  try {
    (void)read_poly(text);
  } catch (const MeshFileError& error) {
    return fmt::format("{}:{}: {}", error.line(), error.column(), error.what());
  }
  return "none";
}

TEST(PolyReader, RefusesAtThePlace) {
  EXPECT_THAT(refusal(""), HasSubstr("file has no blocks, the command poly is needed"));
  EXPECT_EQ(
      refusal("poly brick 0 1 0 1 0 1\n jset dip 30\n"),
      "2:2: command jset changes the blocks and is not read, allowed is poly with brick, prism or face");
  EXPECT_THAT(refusal("poly tunnel a 0 0 0"), HasSubstr("1:6: shape of poly (tunnel) is not read"));
  EXPECT_THAT(refusal("poly brick 0 1 0 1 1 0"), HasSubstr("limits of a brick before here (1 to 0)"));
  EXPECT_THAT(refusal("poly brick 0 1 0 1 0 x"),
              HasSubstr("1:22: upper limit of a brick (x), must be a number"));
  EXPECT_THAT(refusal("poly prism a 0 0 0 1 0 0 &\n 0 1"), HasSubstr("2:4: coordinate (), must be a number"));
  EXPECT_THAT(refusal("poly prism a 0 0 0 1 0 0 0 1 0 b 0 0 1 1 0 1 0 1 1 1 1 1"),
              HasSubstr("face b has 4 corners, face a has 3"));
  EXPECT_THAT(refusal("poly face 0 0 0 1 0 0 0 1 0"), HasSubstr("block has 1 faces, at least 4 are needed"));
  EXPECT_THAT(refusal("poly brick 0 1 0 1 0 1 fast"), HasSubstr("1:24: word after a block (fast)"));
  EXPECT_THAT(refusal("poly brick 0 1 0 1 0 1\nfix range sphere 1"),
              HasSubstr("element of a range (sphere) is not read"));
  EXPECT_THAT(refusal("poly brick 0 1 0 1 0 1\nfix range nrange a"),
              HasSubstr("range before here (a) is unknown"));
  EXPECT_THAT(refusal("poly brick 0 1e200 0 1 0 1"),
              HasSubstr("1:14: upper limit of a brick (1e200), allowed -1e150"));
  EXPECT_THAT(refusal("poly brick 0 1 0 1 0 1\nprop mat 1 dens 0"),
              HasSubstr("density of material 1 (0), must be > 0"));
}

TEST(PolyReader, EndsAnywhere) {
  for (std::size_t size = 0; size < data.size(); ++size) {
    try {
      (void)read_poly(std::string_view(data).substr(0, size));
    } catch (const MeshFileError& error) {
      EXPECT_STRNE(error.what(), "");
    }
  }
}

}  // namespace
}  // namespace ashlar::poly_reader_test

#include "geometry/cutting/small_pieces.hpp"

#include <gtest/gtest.h>

#include "geometry/cutting/cut_solid.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::small_pieces_test {
namespace {

const CutSolid::Choice always = [](int) { return true; };

CutSolid cube(double size) {
  return CutSolid(Polyhedron(make_box(Vector3::Zero(), Vector3::Constant(size))));
}

TEST(SmallPieces, AreGluedToTheNeighbourWithMostArea) {
  CutSolid solid = cube(1.0);
  solid.cut({Vector3::UnitX(), Vector3(0.75, 0, 0)}, 0, always);
  solid.cut({Vector3::UnitZ(), Vector3(0, 0, 0.9)}, 1, always);
  // 0.675, 0.075, 0.225, 0.025: the last goes to the third (0.25), not to the second (0.1).
  EXPECT_EQ(glue_small_pieces(solid, 0.05, always), 1);
  std::vector<double> volumes;
  for (const int piece : solid.pieces()) volumes.push_back(solid.volume(piece));
  ASSERT_EQ(volumes.size(), 3U);
  EXPECT_NEAR(volumes[2], 0.25, 1e-15);
  EXPECT_EQ(Polyhedron(solid.mesh(solid.pieces()[2])).mesh().points.size(), 8U) << "the two are a box again";
  EXPECT_EQ(glue_small_pieces(solid, 10.0, always), 2) << "all become one";
  EXPECT_EQ(solid.pieces().size(), 1U);
  EXPECT_EQ(Polyhedron(solid.mesh(solid.pieces()[0])).faces().size(), 6U);
}

// Three upright sets at 60 degrees meet three at a time in lines, but for rounding: slivers of 1e-30 m^3
// between prisms, and sliver faces. Once the slivers are glued, each prism is a solid at the resolution of
// its coordinates. @return number of slivers
int glued_hexagonal_joints(double dip_direction) {
  CutSolid solid = cube(10.0);
  for (int set = 0; set < 3; ++set)
    for (int k = -4; k <= 4; ++k)
      solid.cut({plane_normal(90, dip_direction + 60.0 * set), Vector3::Constant(5.0), 2.0 * k}, set, always);
  const std::size_t cut = solid.pieces().size();
  const int glued = glue_small_pieces(solid, 1e-9, always);
  EXPECT_EQ(solid.pieces().size(), cut - static_cast<std::size_t>(glued));
  constexpr double resolution = 0x1p-46 * 10.0;
  double sum = 0.0;
  for (const int piece : solid.pieces()) {
    const Polyhedron body(solid.mesh(piece, resolution), resolution);
    EXPECT_TRUE(body.convex());
    EXPECT_NEAR(body.volume(), solid.volume(piece), 1e-12);
    sum += solid.volume(piece);
  }
  EXPECT_NEAR(sum, 1000.0, 1e-10);
  return glued;
}

TEST(SmallPieces, HexagonalJointsLeavePrisms) {
  EXPECT_GT(glued_hexagonal_joints(10.0), 10);
  EXPECT_EQ(glued_hexagonal_joints(0.0), 0) << "cosines of 60 degrees are exact: the sets meet in lines";
}

}  // namespace
}  // namespace ashlar::small_pieces_test

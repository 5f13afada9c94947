#include "apps/scene/meshes/height_grid.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "apps/scene/meshes/open_terrain.hpp"
#include "geometry/mesh/mesh_io.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar::height_grid_test {
namespace {

TriangleMesh esri(const std::string& text) {
  std::istringstream content(text);
  return parse_esri_grid(content);
}

TriangleMesh xyz(const std::string& text) {
  std::istringstream content(text);
  return parse_xyz_grid(content);
}

const std::string head = "ncols 3\nNROWS 2\nxllcorner 100\nyllcorner 200\ncellsize 10\n";

TEST(HeightGrid, EsriHeightsAreThoseOfTheMiddlesOfCellsFromNorthToSouth) {
  const TriangleMesh mesh = esri(head + "1 2 3\n4 5 6\n");
  ASSERT_EQ(mesh.points.size(), 6U);
  ASSERT_EQ(mesh.triangles.size(), 4U);
  // South-west first.
  EXPECT_EQ(mesh.points[0], Vector3(105, 205, 4));
  EXPECT_EQ(mesh.points[1], Vector3(115, 205, 5));
  EXPECT_EQ(mesh.points[2], Vector3(115, 215, 2));
  EXPECT_EQ(mesh.points[3], Vector3(105, 215, 1));
  EXPECT_EQ(esri("ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n1 1 1\n1\n").points[0],
            Vector3(0, 0, 1));
}

TEST(HeightGrid, CellsWithoutAHeightAreLeftOut) {
  const TriangleMesh mesh = esri(head + "nodata_value -9999\n1 2 -9999\n4 5 6\n");
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST(HeightGrid, PointsOfAnXyzFileComeInAnyOrder) {
  const TriangleMesh mesh = xyz("x,y,z\n10,5,3\n0,0,1\n10,0,2\n0,5,4\n20,0,7\n");
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.points[0], Vector3(0, 0, 1));
  EXPECT_EQ(mesh.points[2], Vector3(10, 5, 3));
}

void expect_fault(const std::function<void()>& read, const std::string& what, int line) {
  try {
    read();
    ADD_FAILURE() << "no fault, " << what;
  } catch (const MeshFileError& error) {
    EXPECT_EQ(error.what(), what);
    EXPECT_EQ(error.line(), line) << what;
  }
}

TEST(HeightGrid, FaultsHaveTheirPlace) {
  expect_fault([] { esri(head + "1 2 3\n4 5\n"); }, "grid has 5 heights, ncols times nrows is 6", 7);
  expect_fault([] { esri(head + "1 2 3\n4 5 6 7\n"); }, "grid has more heights than ncols times nrows (6)",
               7);
  expect_fault([] { esri(head + "1 2 x\n"); }, "no number (\"x\")", 6);
  expect_fault([] { esri("ncols 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n"); },
               "head of an ESRI grid has no nrows", 5);
  expect_fault([] { esri("ncols 1e5\nnrows 1e5\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n"); },
               "grid has too many points (100000 x 100000), at most 4e+06 are allowed", 6);
  expect_fault([] { xyz("0 0 1\n0 0 2\n"); }, "two points have one x and y (0, 0)", 2);
  expect_fault([] { xyz("0 0 1\n0 1\n"); }, "line has 2 fields, x, y and z are needed", 2);
  expect_fault([] { xyz("0 0 1\n1 1 1\n"); }, "grid has no cell with four heights", 0);
}

// A roof of 2 m by 1 m: heights 1, 2, 1 along x.
TEST(OpenTerrain, BecomesABodyDownToTheBottom) {
  for (const bool downward : {false, true}) {
    TriangleMesh mesh = xyz("0 0 1\n1 0 2\n2 0 1\n0 1 1\n1 1 2\n2 1 1\n");
    if (downward)
      for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
    close_terrain_below(mesh, -1.0);
    const Polyhedron body(mesh);
    // Mean height 1.5 above z = 0 and 1 below, over 2 m^2.
    EXPECT_EQ(body.volume(), 5.0);
    // Two slopes, the bottom and four walls.
    EXPECT_EQ(body.faces().size(), 7U);
  }
}

TEST(OpenTerrain, AHoleBecomesAShaft) {
  std::string points;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) points += std::to_string(x) + " " + std::to_string(y) + " 1\n";
  TriangleMesh mesh = xyz(points);
  // Without the cell in the middle.
  std::erase_if(mesh.triangles, [&](const auto& triangle) {
    double x = 0.0, y = 0.0;
    for (const int corner : triangle) {
      x += mesh.points[static_cast<std::size_t>(corner)].x() / 3.0;
      y += mesh.points[static_cast<std::size_t>(corner)].y() / 3.0;
    }
    return x > 1.0 && x < 2.0 && y > 1.0 && y < 2.0;
  });
  close_terrain_below(mesh, 0.0);
  EXPECT_EQ(Polyhedron(mesh).volume(), 8.0);
}

TEST(OpenTerrain, RefusesWhatHasNoBodyBelow) {
  const auto fault = [](TriangleMesh mesh, double bottom) -> std::string {
    try {
      close_terrain_below(mesh, bottom);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const TriangleMesh flat = xyz("0 0 1\n1 0 2\n0 1 1\n1 1 2\n");
  EXPECT_EQ(fault(flat, 1.0), "surface reaches down to z = 1, close_below (1) must be lower");
  TriangleMesh upright = flat;
  upright.points.emplace_back(0.5, 0.0, 9.0);
  upright.triangles.push_back({0, 1, 4});
  EXPECT_EQ(fault(upright, 0.0),
            "triangle 3 is upright or overhangs, a surface with one height at each place is needed");
  TriangleMesh twice = flat;
  twice.triangles.push_back(twice.triangles[0]);
  EXPECT_EQ(fault(twice, 0.0),
            "edge between points 1 and 2 has several triangles on one side, one surface is needed");
}

}  // namespace
}  // namespace ashlar::height_grid_test

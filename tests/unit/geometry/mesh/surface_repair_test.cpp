#include "geometry/mesh/surface_repair.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::surface_repair_test {
namespace {

TEST(SurfaceRepair, LeavesASolidAsItIs) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 2, 3});
  const SurfaceRepair repair = repair_surface(mesh);
  EXPECT_EQ(repair.removed + repair.holes + repair.added, 0U);
  EXPECT_FALSE(repair.turned);
  EXPECT_TRUE(repair.complete);
  EXPECT_EQ(Polyhedron(mesh).volume(), 6.0);
}

TEST(SurfaceRepair, FillsHoles) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 2, 3});
  // Both triangles of a face that is flat, and of no other: those whose corners all have z = 3.
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](int k) { return mesh.points[static_cast<std::size_t>(k)].z() == 3.0; });
  });
  ASSERT_EQ(mesh.triangles.size(), 10U);
  const SurfaceRepair repair = repair_surface(mesh);
  EXPECT_EQ(repair.holes, 1U);
  EXPECT_EQ(repair.added, 2U);
  EXPECT_EQ(Polyhedron(mesh).volume(), 6.0);
}

TEST(SurfaceRepair, TurnsTrianglesAlikeAndOutward) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 2, 3});
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3)
    std::swap(mesh.triangles[k][0], mesh.triangles[k][1]);
  EXPECT_FALSE(Polyhedron::find_defects(mesh).empty());
  (void)repair_surface(mesh);
  EXPECT_EQ(Polyhedron(mesh).volume(), 6.0);
  for (auto& corners : mesh.triangles) std::swap(corners[0], corners[1]);
  EXPECT_TRUE(repair_surface(mesh).turned);
  EXPECT_EQ(Polyhedron(mesh).volume(), 6.0);
}

TEST(SurfaceRepair, LeavesOutWhatIsDouble) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 2, 3});
  mesh.triangles.push_back(mesh.triangles.front());
  mesh.triangles.push_back({0, 0, 1});
  // A soup: every triangle has points of its own.
  TriangleMesh soup;
  for (const auto& corners : mesh.triangles) {
    const int first = static_cast<int>(soup.points.size());
    for (const int k : corners) soup.points.push_back(mesh.points[static_cast<std::size_t>(k)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(repair_surface(soup).removed, 2U);
  EXPECT_EQ(soup.points.size(), 8U);
  EXPECT_EQ(Polyhedron(soup).volume(), 6.0);
}

}  // namespace
}  // namespace ashlar::surface_repair_test

#include "geometry/mesh/mesh_repair.hpp"

#include <gmock/gmock.h>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::mesh_repair_test {
namespace {

using ::testing::SizeIs;

void append(TriangleMesh& all, const TriangleMesh& part) {
  const int first = static_cast<int>(all.points.size());
  all.points.insert(all.points.end(), part.points.begin(), part.points.end());
  for (const auto& [a, b, c] : part.triangles) all.triangles.push_back({a + first, b + first, c + first});
}

// Every triangle with corners of its own, a little off.
TriangleMesh soup_of(const TriangleMesh& mesh, double off) {
  TriangleMesh soup;
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle)
      soup.points.push_back(mesh.points[static_cast<std::size_t>(corner)] +
                            off * Vector3(static_cast<double>(soup.points.size() % 3) - 1.0, 0.0, 0.0));
    const int last = static_cast<int>(soup.points.size());
    soup.triangles.push_back({last - 3, last - 2, last - 1});
  }
  return soup;
}

TEST(WeldCorners, MakesASoupASolid) {
  TriangleMesh mesh = soup_of(make_box({0, 0, 0}, {1, 2, 3}), 1e-7);
  const WeldCount count = weld_corners(mesh, 1e-6);
  EXPECT_EQ(count.corners, 36U - 8U);
  EXPECT_EQ(count.triangles, 0U);
  EXPECT_NEAR(Polyhedron(mesh, 1e-6).volume(), 6.0, 1e-5);
}

TEST(WeldCorners, MovesNothingFartherThanAsked) {
  // Three in a row: the third is too far from the first, which the second has become.
  TriangleMesh mesh{{{0, 0, 0}, {1e-3, 0, 0}, {1.8e-3, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                    {{0, 3, 4}, {1, 3, 4}, {2, 3, 4}, {0, 1, 4}}};
  const WeldCount count = weld_corners(mesh, 1.2e-3);
  EXPECT_EQ(count.corners, 1U);
  EXPECT_EQ(count.triangles, 1U) << "the one between the first two";
  EXPECT_THAT(mesh.points, SizeIs(4));
  EXPECT_THAT(mesh.triangles, SizeIs(3));
}

TEST(WeldCorners, RefusesDistancesThatSaveNoShape) {
  TriangleMesh mesh = make_box({0, 0, 0}, {1, 2, 3});
  EXPECT_THROW(weld_corners(mesh, 0.31), std::invalid_argument);
  EXPECT_THROW(weld_corners(mesh, 1e-16), std::invalid_argument);
  mesh.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(weld_corners(mesh, 0.1), std::invalid_argument);
}

TEST(ClosedComponents, TellStonesApartThatTouch) {
  // Two boxes with a common face, one with a common edge, one apart; equal corners are one.
  const std::vector<TriangleMesh> boxes = {make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 0, 0}, {2, 1, 1}),
                                           make_box({2, 1, 0}, {3, 2, 1}), make_box({5, 5, 5}, {7, 7, 7})};
  TriangleMesh all;
  for (const TriangleMesh& box : boxes) append(all, box);
  EXPECT_EQ(weld_corners(all, 1e-9).corners, 6U);
  const auto parts = closed_components(all, 1e-9);
  ASSERT_THAT(parts, SizeIs(4));
  for (std::size_t k = 0; k < 4; ++k) {
    const Polyhedron solid(parts[k]);
    EXPECT_EQ(solid.volume(), k == 3 ? 8.0 : 1.0) << k;
    EXPECT_THAT(solid.faces(), SizeIs(6));
  }
}

TEST(ClosedComponents, TellAWallApart) {
  // 4 x 3 x 4 bricks, all with common faces, edges and corners.
  TriangleMesh all;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) append(all, make_box(Vector3(i, j, k), Vector3(i + 1, j + 1, k + 1)));
  (void)weld_corners(all, 1e-9);
  EXPECT_THAT(all.points, SizeIs(5 * 4 * 5));
  const auto parts = closed_components(all, 1e-9);
  ASSERT_THAT(parts, SizeIs(48));
  for (const TriangleMesh& part : parts) EXPECT_EQ(Polyhedron(part).volume(), 1.0);
}

TEST(RoundedVolume, TellsInsideFromOutside) {
  TriangleMesh mesh = make_box({1, 1, 1}, {2, 3, 4});
  EXPECT_NEAR(rounded_volume(mesh), 6.0, 1e-14);
  turn_inside_out(mesh);
  EXPECT_NEAR(rounded_volume(mesh), -6.0, 1e-14);
}

}  // namespace
}  // namespace ashlar::mesh_repair_test

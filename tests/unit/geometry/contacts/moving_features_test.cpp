// Counts and faces of a unit cube, by hand.
#include "geometry/contacts/moving_features.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/placed_bodies.hpp"

namespace ashlar::moving_features_test {
namespace {

using test_support::box;
using test_support::PlacedBody;

/// Around the top of the cube from 0 to 1.
const Box around_top{{-0.1, -0.1, 0.9}, {1.1, 1.1, 1.1}};

TEST(MovingFeatures, NearTheTopOfACube) {
  const PlacedBody cube(box({0, 0, 0}, {1, 1, 1}));
  const MovingFeatures features = features_near({&cube.placed, &cube.placed}, around_top);
  EXPECT_EQ(features.points.list.size(), 4U);
  EXPECT_EQ(features.sides.list.size(), 8U);  // of the top, and up to it
  EXPECT_EQ(features.cells.list.size(), 5U);  // all but the bottom
  for (const int point : features.points.list) EXPECT_EQ(cube.placed.point(point).z(), 1.0);
}

TEST(MovingFeatures, OfDividedFacesInnerSidesAreThereOnce) {
  const PlacedBody cube(box({0, 0, 0}, {1, 1, 1}), 0);
  const MovingFeatures features = features_near({&cube.placed, &cube.placed}, around_top);
  EXPECT_EQ(features.points.list.size(), 4U);
  EXPECT_EQ(features.sides.list.size(), 13U);  // and five diagonals
  EXPECT_EQ(features.cells.list.size(), 10U);
}

TEST(MovingFeatures, TheirBoxesHoldTheWholeWay) {
  const PlacedBody low(box({0, 0, 0}, {1, 1, 1}));
  std::vector<Vector3> points = low.surface.points;
  for (Vector3& point : points) point.z() += 5.0;
  const PlacedSurface high(low.surface, points);
  // The bottom passes it on its way from 0 to 5, the top begins below.
  const Box between{{-0.1, -0.1, 3}, {1.1, 1.1, 3.1}};
  const MovingFeatures features = features_near({&low.placed, &high}, between);
  ASSERT_EQ(features.cells.list.size(), 6U);
  ASSERT_EQ(features.points.list.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    const Vector3& start = low.placed.point(features.points.list[k]);
    EXPECT_EQ(features.points.boxes[k].low, start);
    EXPECT_EQ(features.points.boxes[k].high, Vector3(start + Vector3(0, 0, 5)));
  }
}

std::set<int> as_set(const std::vector<int>& faces) {
  return {faces.begin(), faces.end()};
}

TEST(MovingFeatures, FacesThatStandForThem) {
  const PlacedBody cube(box({0, 0, 0}, {1, 1, 1}));
  for (int point = 0; point < 8; ++point) {
    const std::set<int> faces = as_set(faces_of_point(cube.surface, point));
    ASSERT_EQ(faces.size(), 3U);
    Vector3 sum = Vector3::Zero();
    for (const int face : faces) sum += cube.solid.faces()[static_cast<std::size_t>(face)].normal;
    EXPECT_LT((sum - 2.0 * (cube.placed.point(point) - Vector3(0.5, 0.5, 0.5))).norm(), 1e-15);
  }
  // All but the face that is across the cube.
  for (int cell = 0; cell < 6; ++cell) EXPECT_EQ(as_set(faces_of_cell(cube.surface, cell)).size(), 5U);
  // Faces beside an edge and at its ends.
  for (const SurfaceEdge& edge : cube.surface.edges) {
    const SurfaceSide side{edge.ends, edge.cells};
    EXPECT_EQ(as_set(faces_of_side(cube.surface, side)).size(), 4U);
    const Vector3 middle = 0.5 * (cube.placed.point(edge.ends[0]) + cube.placed.point(edge.ends[1]));
    EXPECT_LT((outward_of(cube.placed, side) - 2.0 * (middle - Vector3(0.5, 0.5, 0.5))).norm(), 1e-15);
  }
}

TEST(MovingFeatures, CellsAtAPointAreThoseWithThatCorner) {
  const PlacedBody cube(box({0, 0, 0}, {1, 1, 1}), 1);
  const auto& cells = cube.surface.cells;
  for (std::size_t point = 0; point < cube.surface.points.size(); ++point) {
    std::vector<int> expected;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto& corners = cells[c].corners;
      if (std::find(corners.begin(), corners.end(), static_cast<int>(point)) != corners.end())
        expected.push_back(static_cast<int>(c));
    }
    EXPECT_EQ(cube.surface.cells_at[point], expected);
  }
}

}  // namespace
}  // namespace ashlar::moving_features_test

#include "geometry/contacts/overlap_vertices.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/solid/shapes.hpp"
#include "support/placed_bodies.hpp"

namespace ashlar::overlap_vertices_test {
namespace {

const ContactLimits limits{0.01, 0.01, 0.1};

using Body = test_support::PlacedBody;
using test_support::box;

/// A square frame 0 to 6 with a hole 2 to 4, from z = 0 to 1.
Polyhedron frame() {
  TriangleMesh mesh;
  const std::array<std::array<double, 2>, 8> corners = {
      {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {2, 2}, {4, 2}, {4, 4}, {2, 4}}};
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : corners) mesh.points.emplace_back(x, y, z);
  }
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    const auto quad = [&](int a, int b, int c, int d) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    };
    quad(8 + k, 8 + next, 12 + next, 12 + k);  // top
    quad(k, 4 + k, 4 + next, next);            // bottom
    quad(k, next, 8 + next, 8 + k);            // outside
    quad(4 + k, 12 + k, 12 + next, 4 + next);  // inside
  }
  return Polyhedron(std::move(mesh));
}

std::vector<std::array<double, 2>> points_of(const Body& a, const Body& b) {
  const PairContacts contacts = find_contacts(a.placed, b.placed, limits);
  const auto faces = join_by_faces(a.placed, b.placed, contacts.overlaps);
  std::vector<std::array<double, 2>> points;
  for (const FaceOverlap& face : faces) {
    for (const FaceOverlapPoint& point : face.points) {
      const CellOverlap& overlap = contacts.overlaps[static_cast<std::size_t>(point.overlap)];
      const Eigen::Vector2d& place = overlap.corners[static_cast<std::size_t>(point.corner)].place;
      const Vector3 x = overlap.frame.origin + place.x() * overlap.frame.e1 + place.y() * overlap.frame.e2;
      points.push_back({std::round(x.x() * 1e6) / 1e6, std::round(x.y() * 1e6) / 1e6});
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

TEST(FaceOverlap, ABlockOverAHoleTouchesAtTheVerticesOfAPolygonWithAHole) {
  const Body below(frame());
  const Body above(box({1, 1, 1}, {5, 5, 2}));
  const std::vector<std::array<double, 2>> expected = {{1, 1}, {1, 5}, {2, 2}, {2, 4},
                                                       {4, 2}, {4, 4}, {5, 1}, {5, 5}};
  EXPECT_EQ(points_of(above, below), expected);
  EXPECT_EQ(points_of(below, above), expected);
}

TEST(FaceOverlap, ABeamAcrossAHoleTouchesInTwoPieces) {
  const Body below(frame());
  const Body above(box({-1, 2.5, 1}, {7, 3.5, 2}));
  const std::vector<std::array<double, 2>> expected = {{0, 2.5}, {0, 3.5}, {2, 2.5}, {2, 3.5},
                                                       {4, 2.5}, {4, 3.5}, {6, 2.5}, {6, 3.5}};
  EXPECT_EQ(points_of(above, below), expected);
}

TEST(FaceOverlap, ABlockThatFillsTheHolesRimTouchesInItsCornersOnce) {
  const Body below(frame());
  const Body above(box({2, 0, 1}, {4, 2, 2}));
  const std::vector<std::array<double, 2>> expected = {{2, 0}, {2, 2}, {4, 0}, {4, 2}};
  EXPECT_EQ(points_of(above, below), expected);
}

TEST(FaceOverlap, InnerSidesMakeNoContactPoints) {
  // The square's own diagonal and the triangles of the frame cross it in many places.
  const Body below(frame());
  const Body above(box({0.3, 0.4, 1}, {1.7, 5.1, 2}));
  const std::vector<std::array<double, 2>> expected = {{0.3, 0.4}, {0.3, 5.1}, {1.7, 0.4}, {1.7, 5.1}};
  EXPECT_EQ(points_of(above, below), expected);
}

TEST(FaceOverlap, DividedFacesHaveEveryCornerOfTheDivisionOnce) {
  const Body below(box({0, 0, 0}, {2, 2, 1}), 0);
  const Body above(box({0, 0, 1}, {2, 2, 2}), 0);
  const auto points = points_of(above, below);
  const std::vector<std::array<double, 2>> corners = {{0, 0}, {0, 2}, {2, 0}, {2, 2}};
  std::vector<std::array<double, 2>> crossed = corners;
  crossed.insert(crossed.begin() + 2, {1, 1});
  // The two diagonals either coincide or cross in the middle.
  EXPECT_TRUE(points == corners || points == crossed);
}

}  // namespace
}  // namespace ashlar::overlap_vertices_test

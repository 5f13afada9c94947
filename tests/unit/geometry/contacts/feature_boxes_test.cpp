// Features of a surface with many cells, found by a tree, against those found one after the other.
#include "geometry/contacts/feature_boxes.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "geometry/contacts/moving_features.hpp"
#include "geometry/index.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/placed_bodies.hpp"

namespace ashlar::feature_boxes_test {
namespace {

using test_support::PlacedBody;

/// 1280 triangles.
const PlacedBody sphere(Polyhedron(make_sphere({0, 0, 0}, 1.0, 3)));
const std::vector<Box> places = {{{0.5, 0.5, 0.5}, {0.6, 0.7, 0.8}},
                                 {{-0.1, -0.1, 0.99}, {0.1, 0.1, 1.4}},
                                 {{-3, -3, -3}, {3, 3, 3}},
                                 {{2, 2, 2}, {3, 3, 3}}};

TEST(FeatureBoxes, OfManyCellsAreAllThatMeetTheBox) {
  ASSERT_TRUE(sphere.placed.has_many_cells());
  const SubFaceSurface& surface = sphere.placed.surface();
  for (const Box& around : places) {
    for (const double margin : {0.0, 0.03}) {
      const FeaturesNear near(sphere.placed, around, margin);
      std::vector<int> cells, vertices, edges;
      for (int k = 0; k < static_cast<int>(surface.cells.size()); ++k)
        if (sphere.placed.cell_box(k).grown(margin).meets(around)) cells.push_back(k);
      for (int k = 0; k < static_cast<int>(surface.vertices.size()); ++k) {
        const Vector3& place = sphere.placed.point(surface.vertices[at(k)].point);
        if (Box{place, place}.grown(margin).meets(around)) vertices.push_back(k);
      }
      for (int k = 0; k < static_cast<int>(surface.edges.size()); ++k)
        if (box_of(sphere.placed.edge(k)).grown(margin).meets(around)) edges.push_back(k);
      EXPECT_EQ(near.cells().indices, cells);
      EXPECT_EQ(near.vertices().indices, vertices);
      EXPECT_EQ(near.edges().indices, edges);
    }
  }
}

TEST(FeatureBoxes, OfManyMovingCellsAreAllWhosePathMeetsTheBox) {
  std::vector<Vector3> points = sphere.placed.points();
  for (Vector3& point : points) point += Vector3(0.1, -0.2, 0.05);
  const PlacedSurface end(sphere.surface, points);
  const SubFaceSurface& surface = sphere.surface;
  for (const Box& around : places) {
    const MovingFeatures features = features_near({&sphere.placed, &end}, around);
    const auto meets = [&](const auto& corners) {
      Box path;
      for (const int point : corners) {
        path.include(sphere.placed.point(point));
        path.include(end.point(point));
      }
      return path.meets(around);
    };
    std::vector<int> cells, corners;
    std::size_t sides = 0;
    for (int k = 0; k < static_cast<int>(surface.cells.size()); ++k)
      if (meets(surface.cells[at(k)].corners)) cells.push_back(k);
    for (int k = 0; k < static_cast<int>(surface.points.size()); ++k)
      if (surface.vertex_of_point[at(k)] >= 0 && meets(std::array{k})) corners.push_back(k);
    for (const SurfaceEdge& edge : surface.edges)
      if (edge.convex && meets(edge.ends)) ++sides;
    EXPECT_EQ(features.cells.list, cells);
    EXPECT_EQ(features.points.list, corners);
    EXPECT_EQ(features.sides.list.size(), sides);
  }
}

}  // namespace
}  // namespace ashlar::feature_boxes_test

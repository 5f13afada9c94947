#include "geometry/contacts/moving_features.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "geometry/contacts/feature_boxes.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

Box swept_box(const MovingSurface& s, std::span<const int> points) {
  Box box;
  for (const int point : points) {
    box.include(s.start->point(point));
    box.include(s.end->point(point));
  }
  return box;
}

/// Adds a feature if its path comes near. @param points of it
template <class Feature>
void add_if_near(const MovingSurface& moving, const Box& around, std::span<const int> points,
                 const Feature& feature, FeatureList<Feature>& features) {
  const Box box = swept_box(moving, points);
  if (!box.meets(around)) return;
  features.list.push_back(feature);
  features.boxes.push_back(box);
}

/// Largest motion of a point along an axis, m.
double largest_motion(const MovingSurface& moving) {
  double most = 0.0;
  if (moving.start == moving.end) return most;
  for (std::size_t p = 0; p < moving.start->points().size(); ++p)
    most = std::max(most, (moving.end->points()[p] - moving.start->points()[p]).cwiseAbs().maxCoeff());
  return most;
}

/// Features that may come near, ascending.
struct Candidates {
  std::vector<int> points, edges, cells;
};

Candidates all_features(const SubFaceSurface& surface) {
  Candidates all;
  all.points.resize(surface.points.size());
  all.edges.resize(surface.edges.size());
  all.cells.resize(surface.cells.size());
  for (std::vector<int>* indices : {&all.points, &all.edges, &all.cells})
    std::iota(indices->begin(), indices->end(), 0);
  return all;
}

Candidates candidates_near(const MovingSurface& moving, const Box& around) {
  const SubFaceSurface& surface = moving.start->surface();
  if (!moving.start->has_many_cells()) return all_features(surface);
  Candidates near;
  // Twice the motion, for rounding.
  near.cells = moving.start->cell_tree().meeting(around.grown(2.0 * largest_motion(moving)));
  near.points = points_of_cells(surface, near.cells);
  near.edges = edges_of_cells(surface, near.cells);
  return near;
}

}  // namespace

MovingFeatures features_near(const MovingSurface& moving, const Box& around) {
  const SubFaceSurface& surface = moving.start->surface();
  const Candidates candidates = candidates_near(moving, around);
  MovingFeatures features;
  for (const int p : candidates.points) {
    if (!surface.cells_at[at(p)].empty() && (surface.divided || surface.vertex_of_point[at(p)] >= 0))
      add_if_near(moving, around, {&p, 1}, p, features.points);
  }
  const auto add_side = [&](const SurfaceSide& side) {
    add_if_near(moving, around, side.ends, side, features.sides);
  };
  for (const int e : candidates.edges) {
    const SurfaceEdge& edge = surface.edges[at(e)];
    if (edge.convex) add_side({edge.ends, edge.cells});
  }
  for (const int c : candidates.cells) {
    const SurfaceCell& cell = surface.cells[at(c)];
    add_if_near(moving, around, cell.corners, c, features.cells);
    for (std::size_t k = 0; surface.divided && k < 3; ++k) {
      const int start = cell.corners[k];
      const int end = cell.corners[(k + 1) % 3];
      if (cell.rim[k] < 0 && start < end) add_side({{start, end}, {c, c}});
    }
  }
  return features;
}

std::vector<int> faces_of_point(const SubFaceSurface& surface, int point) {
  std::vector<int> faces;
  for (const int cell : surface.cells_at[at(point)]) faces.push_back(surface.cells[at(cell)].face);
  return faces;
}

std::vector<int> faces_of_cell(const SubFaceSurface& surface, int cell) {
  const int own = surface.cells[at(cell)].face;
  std::vector<int> faces = surface.convex_neighbours[at(own)];
  faces.push_back(own);
  return faces;
}

std::vector<int> faces_of_side(const SubFaceSurface& surface, const SurfaceSide& side) {
  const std::array<int, 2> beside = {surface.cells[at(side.cells[0])].face,
                                     surface.cells[at(side.cells[1])].face};
  std::vector<int> faces(beside.begin(), beside.end());
  for (const int point : side.ends) {
    for (const int cell : surface.cells_at[at(point)]) {
      const int face = surface.cells[at(cell)].face;
      const auto& joined = surface.convex_neighbours[at(face)];
      if (std::any_of(beside.begin(), beside.end(),
                      [&](int own) { return std::binary_search(joined.begin(), joined.end(), own); }))
        faces.push_back(face);
    }
  }
  return faces;
}

Vector3 outward_of(const PlacedSurface& surface, const SurfaceSide& side) {
  return surface.normal(side.cells[0]) + surface.normal(side.cells[1]);
}

}  // namespace ashlar

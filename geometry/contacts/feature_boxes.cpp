#include "geometry/contacts/feature_boxes.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

std::vector<int> distinct(std::vector<int> indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

}  // namespace

double chord_bound(const PlacedSurface& s, const SurfaceEdge& edge) {
  return std::max(s.chord_bound(edge.cells[0]), s.chord_bound(edge.cells[1]));
}

std::vector<int> points_of_cells(const SubFaceSurface& surface, const std::vector<int>& cells) {
  std::vector<int> points;
  for (const int cell : cells) {
    const std::vector<int>& corners = surface.cells[at(cell)].corners;
    points.insert(points.end(), corners.begin(), corners.end());
  }
  return distinct(std::move(points));
}

std::vector<int> edges_of_cells(const SubFaceSurface& surface, const std::vector<int>& cells) {
  std::vector<int> edges;
  for (const int cell : cells)
    edges.insert(edges.end(), surface.edges_of[at(cell)].begin(), surface.edges_of[at(cell)].end());
  return distinct(std::move(edges));
}

FeaturesNear::FeaturesNear(const PlacedSurface& surface, const Box& around, double margin)
    : surface_(surface), around_(around), margin_(margin) {
  // Twice the margin: boxes that are grown themselves meet the given one by other roundings.
  if (surface.has_many_cells())
    cells_ = surface.cell_tree().meeting(around.grown(2.0 * (margin + surface.largest_chord_bound())));
}

template <class BoxOf>
IndexedBoxes FeaturesNear::near_of(std::size_t count, const std::vector<int>& candidates,
                                   const BoxOf& box_of_feature) const {
  IndexedBoxes features;
  const auto add_if_near = [&](int k) {
    const Box box = box_of_feature(k);
    if (!box.meets(around_)) return;
    features.indices.push_back(k);
    features.boxes.push_back(box);
  };
  if (surface_.has_many_cells()) {
    for (const int k : candidates) add_if_near(k);
  } else {
    for (int k = 0; k < static_cast<int>(count); ++k) add_if_near(k);
  }
  return features;
}

IndexedBoxes FeaturesNear::cells() const {
  return near_of(surface_.surface().cells.size(), cells_,
                 [&](int cell) { return surface_.cell_box(cell).grown(margin_); });
}

IndexedBoxes FeaturesNear::vertices() const {
  const SubFaceSurface& surface = surface_.surface();
  std::vector<int> candidates;
  for (const int point : points_of_cells(surface, cells_))
    if (surface.vertex_of_point[at(point)] >= 0) candidates.push_back(surface.vertex_of_point[at(point)]);
  return near_of(surface.vertices.size(), distinct(std::move(candidates)), [&](int vertex) {
    const Vector3& place = surface_.point(surface.vertices[at(vertex)].point);
    return Box{place, place}.grown(margin_);
  });
}

IndexedBoxes FeaturesNear::edges() const {
  const SubFaceSurface& surface = surface_.surface();
  return near_of(surface.edges.size(), edges_of_cells(surface, cells_), [&](int edge) {
    return box_of(surface_.edge(edge)).grown(margin_ + chord_bound(surface_, surface.edges[at(edge)]));
  });
}

}  // namespace ashlar

#include "solver/contact/open_faces.hpp"

#include <algorithm>
#include <limits>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

class OpenFaces {
 public:
  OpenFaces(const MovingSurface& a, const MovingSurface& b, const OccludedPlaces& hidden)
      : a_(a), b_(b), hidden_(hidden) {}

  void turn(std::vector<Touch>& touches) const {
    std::erase_if(touches, [this](Touch& touch) {
      auto* vertex = std::get_if<VertexContact>(&touch.contact);
      return vertex != nullptr && is_hidden(*vertex) && !turn(*vertex);
    });
    // A vertex that passes the occluded side and the adjacent face in one step touches that face once.
    for (std::size_t k = 0; k < touches.size(); ++k) {
      const auto rest = touches.begin() + static_cast<std::ptrdiff_t>(k) + 1;
      touches.erase(
          std::remove_if(rest, touches.end(), [&](const Touch& other) { return same(touches[k], other); }),
          touches.end());
    }
  }

 private:
  /// True if two touches are of the same vertex and cell.
  static bool same(const Touch& first, const Touch& second) {
    const auto* one = std::get_if<VertexContact>(&first.contact);
    const auto* other = std::get_if<VertexContact>(&second.contact);
    return one != nullptr && other != nullptr && one->vertex_of_a == other->vertex_of_a &&
           one->point == other->point && one->cell == other->cell;
  }
  [[nodiscard]] const MovingSurface& with_cell(const VertexContact& vertex) const {
    return vertex.vertex_of_a ? b_ : a_;
  }
  [[nodiscard]] double gap(const VertexContact& vertex, int cell, bool at_end) const {
    const MovingSurface& with_vertex = vertex.vertex_of_a ? a_ : b_;
    const PlacedSurface& points = at_end ? *with_vertex.end : *with_vertex.start;
    const PlacedSurface& cells = at_end ? *with_cell(vertex).end : *with_cell(vertex).start;
    const Vector3& in_plane = cells.point(cells.surface().cells[at(cell)].corners[0]);
    return cells.normal(cell).dot(points.point(vertex.point) - in_plane);
  }
  /// True if it passes through the occluded side, or ends beside it: it may start above.
  [[nodiscard]] bool is_hidden(const VertexContact& vertex) const {
    const auto& hides = vertex.vertex_of_a ? hidden_.of_b : hidden_.of_a;
    const int face = with_cell(vertex).start->surface().cells[at(vertex.cell)].face;
    return hides(face, foot(vertex, false)) || hides(face, foot(vertex, true));
  }
  [[nodiscard]] Vector3 foot(const VertexContact& vertex, bool at_end) const {
    const MovingSurface& with_vertex = vertex.vertex_of_a ? a_ : b_;
    const PlacedSurface& points = at_end ? *with_vertex.end : *with_vertex.start;
    const PlacedSurface& cells = at_end ? *with_cell(vertex).end : *with_cell(vertex).start;
    return points.point(vertex.point) - gap(vertex, vertex.cell, at_end) * cells.normal(vertex.cell);
  }
  /// @return false if it ends outside of the block
  [[nodiscard]] bool turn(VertexContact& vertex) const {
    const SubFaceSurface& surface = with_cell(vertex).start->surface();
    const auto& beside = surface.convex_neighbours[at(surface.cells[at(vertex.cell)].face)];
    double least = -std::numeric_limits<double>::infinity();
    for (int cell = 0; cell < static_cast<int>(surface.cells.size()); ++cell) {
      if (!std::binary_search(beside.begin(), beside.end(), surface.cells[at(cell)].face)) continue;
      const double end = gap(vertex, cell, true);
      if (end <= least) continue;
      least = end;
      vertex.cell = cell;
    }
    vertex.gap = gap(vertex, vertex.cell, false);
    return least < 0.0;
  }

  const MovingSurface a_;
  const MovingSurface b_;
  const OccludedPlaces& hidden_;
};

}  // namespace

void turn_to_open_faces(const MovingSurface& a, const MovingSurface& b, const OccludedPlaces& hidden,
                        std::vector<Touch>& touches) {
  OpenFaces(a, b, hidden).turn(touches);
}

}  // namespace ashlar

#include "geometry/contact_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace ashlar {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

Box box_of(std::span<const Vector3> points) {
  Box box{points.front(), points.front()};
  for (const Vector3& point : points) {
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

Box grown(const Box& box, double margin) {
  return {box.low - Vector3::Constant(margin), box.high + Vector3::Constant(margin)};
}

/// Height of the plane of a cell over a place of the frame, along w.
class CellHeight {
 public:
  CellHeight(const PlacedSurface& s, int cell, const ViewFrame& frame)
      : point_(s.point(s.surface().cells[at(cell)].corners[0]) - frame.origin),
        normal_(s.normal(cell)),
        frame_(&frame) {}
  double operator()(const Eigen::Vector2d& place) const {
    const Vector3 flat = place.x() * frame_->e1 + place.y() * frame_->e2;
    return normal_.dot(point_ - flat) / normal_.dot(frame_->w);
  }

 private:
  Vector3 point_;
  Vector3 normal_;
  const ViewFrame* frame_;
};

std::optional<CellOverlap> overlap_of_cells(const PlacedSurface& a, int cell_a, const PlacedSurface& b,
                                            int cell_b, const ContactLimits& limits,
                                            PredicateCounts& counts) {
  const auto corners_a = a.corners(cell_a);
  const auto corners_b = b.corners(cell_b);
  const ViewFrame frame(corners_b.front(), b.normal(cell_b) - a.normal(cell_a));
  auto corners = overlap_polygon(corners_a, corners_b, frame, counts);
  if (corners.size() < 3) return std::nullopt;
  CellOverlap overlap{cell_a, cell_b, frame, std::move(corners), {}};
  const CellHeight height_a(a, cell_a, frame);
  const CellHeight height_b(b, cell_b, frame);
  double least = std::numeric_limits<double>::infinity();
  for (const OverlapCorner& corner : overlap.corners) {
    overlap.gaps.push_back(height_a(corner.place) - height_b(corner.place));
    least = std::min(least, overlap.gaps.back());
  }
  if (least > limits.reach || least < -limits.penetration) return std::nullopt;
  return overlap;
}

/// Whether some cell of a list faces a given direction's opposite within the angle.
bool any_facing(const PlacedSurface& s, const std::vector<int>& cells, const Vector3& normal, double cosine) {
  return std::any_of(cells.begin(), cells.end(),
                     [&](int cell) { return s.normal(cell).dot(normal) <= -cosine; });
}

/// A vertex is an end of the block against a normal if no neighbour lies deeper than the angle allows and
/// some face around it looks that way.
bool is_end(const PlacedSurface& s, const SurfaceVertex& vertex, const Vector3& normal, double sine) {
  const Vector3& place = s.point(vertex.point);
  for (const int neighbour : vertex.neighbours) {
    const Vector3 side = s.point(neighbour) - place;
    if (normal.dot(side) < -sine * side.norm()) return false;
  }
  return std::any_of(vertex.cells.begin(), vertex.cells.end(),
                     [&](int cell) { return s.normal(cell).dot(normal) < 0.0; });
}

bool foot_inside(const PlacedSurface& s, int cell, const Vector3& point, PredicateCounts& counts) {
  const auto& corners = s.surface().cells[at(cell)].corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (orientation_along(s.normal(cell), s.point(corners[k]), s.point(corners[(k + 1) % corners.size()]),
                          point, counts) < 0) {
      return false;
    }
  }
  return true;
}

/// Mean over the faces around some cells of the area that falls to one corner of each.
double tributary_area(const SubFaceSurface& surface, const std::vector<int>& cells) {
  double sum = 0.0;
  for (const int cell : cells) sum += surface.face_share[at(surface.cells[at(cell)].face)];
  return sum / static_cast<double>(cells.size());
}

bool faces_touch(const SubFaceSurface& surface, int face_a, int face_b) {
  const auto& neighbours = surface.face_neighbours[at(face_a)];
  return face_a == face_b || std::binary_search(neighbours.begin(), neighbours.end(), face_b);
}

/// Contacts of the vertices of one block with the cells of the other.
void find_vertex_contacts(const PlacedSurface& with_vertex, const std::vector<int>& vertices,
                          const PlacedSurface& with_cell, const std::vector<int>& cells, bool vertex_of_a,
                          const ContactLimits& limits, PairContacts& contacts) {
  const double cosine = std::cos(limits.angle);
  const double sine = std::sin(limits.angle);
  const double margin = std::max(limits.reach, limits.penetration);
  for (const int v : vertices) {
    const SurfaceVertex& vertex = with_vertex.surface().vertices[at(v)];
    const Vector3& place = with_vertex.point(vertex.point);
    const Box around = grown({place, place}, margin);
    std::vector<VertexContact> found;
    for (const int cell : cells) {
      if (!around.meets(with_cell.cell_box(cell))) continue;
      const Vector3& normal = with_cell.normal(cell);
      const double gap = normal.dot(place - with_cell.point(with_cell.surface().cells[at(cell)].corners[0]));
      if (gap > limits.reach || gap < -limits.penetration) continue;
      if (!is_end(with_vertex, vertex, normal, sine)) continue;
      if (any_facing(with_vertex, vertex.cells, normal, cosine)) continue;
      if (!foot_inside(with_cell, cell, place, contacts.counts)) continue;
      found.push_back({vertex_of_a, v, cell, gap, tributary_area(with_vertex.surface(), vertex.cells)});
    }
    // Of faces that share an edge the vertex entered through one only: where it is least deep.
    std::stable_sort(found.begin(), found.end(),
                     [](const VertexContact& p, const VertexContact& q) { return p.gap > q.gap; });
    const auto face_of = [&](const VertexContact& contact) {
      return with_cell.surface().cells[at(contact.cell)].face;
    };
    std::vector<VertexContact> kept;
    for (const VertexContact& contact : found) {
      const bool repeated = std::any_of(kept.begin(), kept.end(), [&](const VertexContact& other) {
        return faces_touch(with_cell.surface(), face_of(contact), face_of(other));
      });
      if (!repeated) kept.push_back(contact);
    }
    contacts.vertices.insert(contacts.vertices.end(), kept.begin(), kept.end());
  }
}

/// Whether the block is on the far side of its edge seen from the normal's tip: both cells lean away from
/// `outward`.
bool edge_is_end(const PlacedSurface& s, const SurfaceEdge& edge, const Vector3& outward, double sine) {
  const Vector3 along = (s.point(edge.ends[1]) - s.point(edge.ends[0])).normalized();
  // The edge runs counter-clockwise on its left cell, whose inside is to the left of it seen from outside.
  const Vector3 into_left = s.normal(edge.cells[0]).cross(along);
  const Vector3 into_right = along.cross(s.normal(edge.cells[1]));
  return outward.dot(into_left) <= sine && outward.dot(into_right) <= sine;
}

std::optional<EdgeContact> edge_contact(const PlacedSurface& a, int edge_a, const PlacedSurface& b,
                                        int edge_b, const ContactLimits& limits) {
  const SurfaceEdge& ea = a.surface().edges[at(edge_a)];
  const SurfaceEdge& eb = b.surface().edges[at(edge_b)];
  if (!ea.convex || !eb.convex) return std::nullopt;
  const Vector3 u = a.point(ea.ends[1]) - a.point(ea.ends[0]);
  const Vector3 v = b.point(eb.ends[1]) - b.point(eb.ends[0]);
  const Vector3 r = a.point(ea.ends[0]) - b.point(eb.ends[0]);
  Vector3 normal = u.cross(v);
  const double sine = std::sin(limits.angle);
  if (normal.norm() <= sine * u.norm() * v.norm()) return std::nullopt;
  const double squared = normal.squaredNorm();
  // Seen along the normal the edges cross at a0 + s u = b0 + t v (+ gap along the normal).
  const double s = v.cross(r).dot(normal) / squared;
  const double t = u.cross(r).dot(normal) / squared;
  if (!(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)) return std::nullopt;
  normal /= std::sqrt(squared);
  // Out of b: the side to which the faces of b look.
  const Vector3 out_of_b = b.normal(eb.cells[0]) + b.normal(eb.cells[1]);
  if (normal.dot(out_of_b) < 0.0) normal = -normal;
  const double gap = normal.dot(r);
  if (gap > limits.reach || gap < -limits.penetration) return std::nullopt;
  if (!edge_is_end(b, eb, normal, sine) || !edge_is_end(a, ea, -normal, sine)) return std::nullopt;
  const std::vector<int> cells_a(ea.cells.begin(), ea.cells.end());
  const std::vector<int> cells_b(eb.cells.begin(), eb.cells.end());
  const double cosine = std::cos(limits.angle);
  for (const int cell : cells_b) {
    if (any_facing(a, cells_a, b.normal(cell), cosine)) return std::nullopt;
  }
  const double area = std::min(tributary_area(a.surface(), cells_a), tributary_area(b.surface(), cells_b));
  return EdgeContact{edge_a, edge_b, s, t, normal, gap, area};
}

/// Indices of the cells whose box meets a box.
std::vector<int> cells_meeting(const PlacedSurface& s, const Box& box) {
  std::vector<int> cells;
  for (int cell = 0; cell < static_cast<int>(s.surface().cells.size()); ++cell) {
    if (s.cell_box(cell).meets(box)) cells.push_back(cell);
  }
  return cells;
}

std::vector<int> vertices_meeting(const PlacedSurface& s, const Box& box) {
  std::vector<int> vertices;
  for (int v = 0; v < static_cast<int>(s.surface().vertices.size()); ++v) {
    const Vector3& place = s.point(s.surface().vertices[at(v)].point);
    if (box.meets({place, place})) vertices.push_back(v);
  }
  return vertices;
}

Box edge_box(const PlacedSurface& s, int edge) {
  const auto& ends = s.surface().edges[at(edge)].ends;
  const std::array<Vector3, 2> places = {s.point(ends[0]), s.point(ends[1])};
  return box_of(places);
}

std::vector<int> edges_meeting(const PlacedSurface& s, const Box& box) {
  std::vector<int> edges;
  for (int e = 0; e < static_cast<int>(s.surface().edges.size()); ++e) {
    if (edge_box(s, e).meets(box)) edges.push_back(e);
  }
  return edges;
}

}  // namespace

PlacedSurface::PlacedSurface(const SubFaceSurface& surface, std::vector<Vector3> points)
    : surface_(&surface), points_(std::move(points)), box_(box_of(points_)) {
  normals_.reserve(surface.cells.size());
  cell_boxes_.reserve(surface.cells.size());
  for (const SurfaceCell& cell : surface.cells) {
    const Vector3& first = point(cell.corners[0]);
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 1; k + 1 < cell.corners.size(); ++k) {
      area += (point(cell.corners[k]) - first).cross(point(cell.corners[k + 1]) - first);
    }
    normals_.push_back(area.normalized());
    Box box{first, first};
    for (const int corner : cell.corners) {
      box.low = box.low.cwiseMin(point(corner));
      box.high = box.high.cwiseMax(point(corner));
    }
    cell_boxes_.push_back(box);
  }
}

std::vector<Vector3> PlacedSurface::corners(int cell) const {
  std::vector<Vector3> places;
  for (const int corner : surface_->cells[at(cell)].corners) places.push_back(point(corner));
  return places;
}

PairContacts find_contacts(const PlacedSurface& a, const PlacedSurface& b, const ContactLimits& limits) {
  PairContacts contacts;
  const double margin = std::max(limits.reach, limits.penetration);
  const Box box_a = grown(a.box(), margin);
  const Box box_b = grown(b.box(), margin);
  if (!box_a.meets(b.box())) return contacts;
  const auto cells_a = cells_meeting(a, box_b);
  const auto cells_b = cells_meeting(b, box_a);
  const double cosine = std::cos(limits.angle);
  for (const int cell_a : cells_a) {
    const Box around = grown(a.cell_box(cell_a), margin);
    for (const int cell_b : cells_b) {
      if (a.normal(cell_a).dot(b.normal(cell_b)) > -cosine || !around.meets(b.cell_box(cell_b))) continue;
      auto overlap = overlap_of_cells(a, cell_a, b, cell_b, limits, contacts.counts);
      if (overlap) contacts.overlaps.push_back(std::move(*overlap));
    }
  }
  find_vertex_contacts(a, vertices_meeting(a, box_b), b, cells_b, true, limits, contacts);
  find_vertex_contacts(b, vertices_meeting(b, box_a), a, cells_a, false, limits, contacts);
  const auto edges_b = edges_meeting(b, box_a);
  for (const int edge_a : edges_meeting(a, box_b)) {
    const Box around = grown(edge_box(a, edge_a), margin);
    for (const int edge_b : edges_b) {
      if (!around.meets(edge_box(b, edge_b))) continue;
      if (auto contact = edge_contact(a, edge_a, b, edge_b, limits)) contacts.edges.push_back(*contact);
    }
  }
  return contacts;
}

std::vector<std::array<int, 2>> meeting_boxes(const std::vector<Box>& boxes) {
  std::vector<std::array<int, 2>> pairs;
  if (boxes.empty()) return pairs;
  Box all = boxes.front();
  for (const Box& box : boxes) {
    all.low = all.low.cwiseMin(box.low);
    all.high = all.high.cwiseMax(box.high);
  }
  Eigen::Index axis = 0;
  (all.high - all.low).maxCoeff(&axis);
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int i, int j) { return boxes[at(i)].low[axis] < boxes[at(j)].low[axis]; });
  for (std::size_t p = 0; p < order.size(); ++p) {
    const Box& box = boxes[at(order[p])];
    for (std::size_t q = p + 1; q < order.size() && boxes[at(order[q])].low[axis] <= box.high[axis]; ++q) {
      if (box.meets(boxes[at(order[q])]))
        pairs.push_back({std::min(order[p], order[q]), std::max(order[p], order[q])});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace ashlar

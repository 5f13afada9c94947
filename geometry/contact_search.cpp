#include "geometry/contact_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "geometry/box_pairs.hpp"
#include "geometry/rounding_mode.hpp"

namespace ashlar {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
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

/// The corners of a cell as a plane set seen against w: counter-clockwise and strictly convex, which rounding
/// or straight corners may have spoilt.
class ProjectedCell {
 public:
  /// @param towards_viewer whether the cell's outside looks at the viewer
  ProjectedCell(const PlacedSurface& s, int cell, bool towards_viewer, const ContactDirection& w,
                PredicateLadder& ladder)
      : points_(s.corners(cell)), loop_(points_.size()) {
    std::iota(loop_.begin(), loop_.end(), 0);
    if (!towards_viewer) std::reverse(loop_.begin(), loop_.end());
    bool convex = true;
    for (std::size_t k = 0; convex && k < (loop_.size() == 3 ? 1 : loop_.size()); ++k)
      convex = sign_turn(w, corner(k), corner(k + 1), corner(k + 2), ladder) > 0;
    if (convex) return;
    loop_ = loop_.size() > 3 ? projected_hull(w, points_.data(), loop_, ladder) : std::vector<int>{};
  }
  [[nodiscard]] bool has_area() const { return loop_.size() >= 3; }
  [[nodiscard]] PlaneSet plane_set() const { return {points_.data(), loop_}; }
  /// In the numbering of the cell: a side of the loop is the cell's side at the first of its two corners.
  [[nodiscard]] PlaneLocation in_cell(const PlaneLocation& location) const {
    if (location.dimension == 2) return location;
    const int start = loop_[at(location.index)];
    if (location.dimension == 0) return {0, start};
    const int end = loop_[(at(location.index) + 1) % loop_.size()];
    const int count = static_cast<int>(points_.size());
    return {1, (start + 1) % count == end ? start : (end + 1) % count == start ? end : std::min(start, end)};
  }
  [[nodiscard]] const Vector3& corner(std::size_t k) const { return points_[at(loop_[k % loop_.size()])]; }

 private:
  std::vector<Vector3> points_;
  std::vector<int> loop_;
};

Eigen::Vector2d crossing_place(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                               const Eigen::Vector2d& d) {
  const auto cross = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const double share = cross(c - a, d - c) / cross(b - a, d - c);
  return a + std::clamp(share, 0.0, 1.0) * (b - a);
}

bool within_range(const PlacedSurface& a, const PlacedSurface& b, const Vector3& w) {
  NumericRange range = a.range();
  range.include(b.range());
  for (const double component : w) range.include(component);
  return range.safe();
}

std::optional<CellOverlap> overlap_of_cells(const PlacedSurface& a, int cell_a, const PlacedSurface& b,
                                            int cell_b, const ContactLimits& limits, DecisionCounts& counts) {
  const ViewFrame frame(b.point(b.surface().cells[at(cell_b)].corners[0]),
                        without_tiny_parts(b.normal(cell_b) - a.normal(cell_a)));
  const Vector3 direction = without_tiny_parts(frame.w);
  PredicateLadder ladder{within_range(a, b, direction), counts};
  const ContactDirection w = ContactDirection::along({&direction});
  const ProjectedCell seen_a(a, cell_a, false, w, ladder);
  const ProjectedCell seen_b(b, cell_b, true, w, ladder);
  std::vector<OverlapVertex> vertices;
  if (seen_a.has_area() && seen_b.has_area())
    vertices = overlap(w, PlaneSetting::tilted, seen_a.plane_set(), seen_b.plane_set(), ladder);
  counts = ladder.counts;
  if (vertices.size() < 3) return std::nullopt;
  CellOverlap overlap{cell_a, cell_b, frame, {}, {}};
  const CellHeight height_a(a, cell_a, frame);
  const CellHeight height_b(b, cell_b, frame);
  double least = std::numeric_limits<double>::infinity();
  for (const OverlapVertex& vertex : vertices) {
    const auto corner = [&](const ProjectedCell& cell, int k) {
      return frame.project(cell.corner(static_cast<std::size_t>(k)));
    };
    const Eigen::Vector2d place =
        vertex.a.dimension == 0 ? corner(seen_a, vertex.a.index)
        : vertex.b.dimension == 0
            ? corner(seen_b, vertex.b.index)
            : crossing_place(corner(seen_a, vertex.a.index), corner(seen_a, vertex.a.index + 1),
                             corner(seen_b, vertex.b.index), corner(seen_b, vertex.b.index + 1));
    overlap.corners.push_back({seen_a.in_cell(vertex.a), seen_b.in_cell(vertex.b), place});
    overlap.gaps.push_back(height_a(place) - height_b(place));
    least = std::min(least, overlap.gaps.back());
  }
  const double chord = a.chord_bound(cell_a) + b.chord_bound(cell_b);
  if (least > limits.reach + chord || least < -limits.penetration - chord) return std::nullopt;
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

bool foot_inside(const PlacedSurface& with_vertex, const Vector3& point, const PlacedSurface& s, int cell,
                 DecisionCounts& counts) {
  const auto& corners = s.surface().cells[at(cell)].corners;
  const Vector3 normal = without_tiny_parts(s.normal(cell));
  PredicateLadder ladder{within_range(with_vertex, s, normal), counts};
  const ContactDirection w = ContactDirection::along({&normal});
  bool inside = true;
  for (std::size_t k = 0; inside && k < corners.size(); ++k) {
    const Vector3& end = s.point(corners[(k + 1) % corners.size()]);
    inside = sign_turn(w, s.point(corners[k]), end, point, ladder) >= 0;
  }
  counts = ladder.counts;
  return inside;
}

bool faces_touch(const SubFaceSurface& surface, int face_a, int face_b) {
  const auto& neighbours = surface.face_neighbours[at(face_a)];
  return face_a == face_b || std::binary_search(neighbours.begin(), neighbours.end(), face_b);
}

/// Contacts of a vertex of one block with cells of the other.
void find_vertex_contacts(const PlacedSurface& with_vertex, int vertex_index, const PlacedSurface& with_cell,
                          const std::vector<int>& cells, bool vertex_of_a, const ContactLimits& limits,
                          PairContacts& contacts) {
  const double cosine = std::cos(limits.angle);
  const double sine = std::sin(limits.angle);
  const SurfaceVertex& vertex = with_vertex.surface().vertices[at(vertex_index)];
  const Vector3& place = with_vertex.point(vertex.point);
  std::vector<VertexContact> found;
  for (const int cell : cells) {
    const Vector3& normal = with_cell.normal(cell);
    const double gap = normal.dot(place - with_cell.point(with_cell.surface().cells[at(cell)].corners[0]));
    const double chord = with_cell.chord_bound(cell);
    if (gap > limits.reach + chord || gap < -limits.penetration - chord) continue;
    if (!is_end(with_vertex, vertex, normal, sine)) continue;
    if (any_facing(with_vertex, vertex.cells, normal, cosine)) continue;
    if (!foot_inside(with_vertex, place, with_cell, cell, contacts.counts)) continue;
    found.push_back({vertex_of_a, vertex.point, vertex.cells.front(), cell, gap,
                     tributary_area(with_vertex.surface(), vertex.cells)});
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

/// Whether the block is on the far side of its edge seen from the normal's tip: both cells lean away from
/// `outward`.
bool edge_is_end(const PlacedSurface& s, const SurfaceEdge& edge, const Vector3& outward, double sine) {
  const Vector3 along = (s.point(edge.ends[1]) - s.point(edge.ends[0])).normalized();
  // The edge runs counter-clockwise on its left cell, whose inside is to the left of it seen from outside.
  const Vector3 into_left = s.normal(edge.cells[0]).cross(along);
  const Vector3 into_right = along.cross(s.normal(edge.cells[1]));
  return outward.dot(into_left) <= sine && outward.dot(into_right) <= sine;
}

/// Whether two edges cross in inner points of both when seen across both.
bool edges_cross(const PlacedSurface& a, const std::array<Vector3, 2>& edge_a, const PlacedSurface& b,
                 const std::array<Vector3, 2>& edge_b, DecisionCounts& counts) {
  PredicateLadder ladder{within_range(a, b, Vector3::Zero()), counts};
  const ContactDirection w = ContactDirection::cross({&edge_a[1], &edge_a[0]}, {&edge_b[1], &edge_b[0]});
  const auto separates = [&](const std::array<Vector3, 2>& line, const std::array<Vector3, 2>& ends) {
    const SideOfLine side(w, line[0], line[1]);
    return side.sign(ends[0], ladder) * side.sign(ends[1], ladder) < 0;
  };
  const bool cross = separates(edge_a, edge_b) && separates(edge_b, edge_a);
  counts = ladder.counts;
  return cross;
}

double chord_bound(const PlacedSurface& s, const SurfaceEdge& edge) {
  return std::max(s.chord_bound(edge.cells[0]), s.chord_bound(edge.cells[1]));
}

std::optional<EdgeContact> edge_contact(const PlacedSurface& a, int edge_a, const PlacedSurface& b,
                                        int edge_b, const ContactLimits& limits, DecisionCounts& counts) {
  const SurfaceEdge& ea = a.surface().edges[at(edge_a)];
  const SurfaceEdge& eb = b.surface().edges[at(edge_b)];
  if (!ea.convex || !eb.convex) return std::nullopt;
  const std::array<Vector3, 2> ends_a = a.edge(edge_a);
  const std::array<Vector3, 2> ends_b = b.edge(edge_b);
  const Vector3 u = ends_a[1] - ends_a[0];
  const Vector3 v = ends_b[1] - ends_b[0];
  const Vector3 r = ends_a[0] - ends_b[0];
  Vector3 normal = u.cross(v);
  const double sine = std::sin(limits.angle);
  if (normal.norm() <= sine * u.norm() * v.norm()) return std::nullopt;
  const double squared = normal.squaredNorm();
  // Seen along the normal the edges cross at a0 + s u = b0 + t v (+ gap along the normal).
  const double s = std::clamp(v.cross(r).dot(normal) / squared, 0.0, 1.0);
  const double t = std::clamp(u.cross(r).dot(normal) / squared, 0.0, 1.0);
  normal /= std::sqrt(squared);
  // Out of b: the side to which the faces of b look.
  const Vector3 out_of_b = b.normal(eb.cells[0]) + b.normal(eb.cells[1]);
  if (normal.dot(out_of_b) < 0.0) normal = -normal;
  const double gap = normal.dot(r);
  const double chord = chord_bound(a, ea) + chord_bound(b, eb);
  if (gap > limits.reach + chord || gap < -limits.penetration - chord) return std::nullopt;
  if (!edge_is_end(b, eb, normal, sine) || !edge_is_end(a, ea, -normal, sine)) return std::nullopt;
  const std::vector<int> cells_a(ea.cells.begin(), ea.cells.end());
  const std::vector<int> cells_b(eb.cells.begin(), eb.cells.end());
  const double cosine = std::cos(limits.angle);
  for (const int cell : cells_b) {
    if (any_facing(a, cells_a, b.normal(cell), cosine)) return std::nullopt;
  }
  if (!edges_cross(a, ends_a, b, ends_b, counts)) return std::nullopt;
  const double area = std::min(tributary_area(a.surface(), cells_a), tributary_area(b.surface(), cells_b));
  return EdgeContact{{ea.ends, ea.cells[0], s}, {eb.ends, eb.cells[0], t}, normal, gap, area};
}

/// Features of a surface with boxes that meet a given one, and those boxes.
struct NearFeatures {
  std::vector<int> indices;
  std::vector<Box> boxes;
};

template <class BoxOf>
NearFeatures near(std::size_t count, const Box& around, BoxOf box_of_feature) {
  NearFeatures features;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    const Box box = box_of_feature(k);
    if (!box.meets(around)) continue;
    features.indices.push_back(k);
    features.boxes.push_back(box);
  }
  return features;
}

/// Features of a surface near a box, their own boxes grown by a margin.
NearFeatures near_cells(const PlacedSurface& s, const Box& around, double margin) {
  return near(s.surface().cells.size(), around, [&](int cell) { return s.cell_box(cell).grown(margin); });
}

NearFeatures near_vertices(const PlacedSurface& s, const Box& around, double margin) {
  return near(s.surface().vertices.size(), around, [&](int vertex) {
    const Vector3& place = s.point(s.surface().vertices[at(vertex)].point);
    return Box{place, place}.grown(margin);
  });
}

NearFeatures near_edges(const PlacedSurface& s, const Box& around, double margin) {
  return near(s.surface().edges.size(), around, [&](int edge) {
    return box_of(s.edge(edge)).grown(margin + chord_bound(s, s.surface().edges[at(edge)]));
  });
}

/// All vertices of one block against cells of the other.
void find_all_vertex_contacts(const PlacedSurface& with_vertex, const NearFeatures& vertices,
                              const PlacedSurface& with_cell, const NearFeatures& cells, bool vertex_of_a,
                              const ContactLimits& limits, PairContacts& contacts) {
  const auto pairs = meeting_boxes(vertices.boxes, cells.boxes);
  for (std::size_t first = 0; first < pairs.size();) {
    std::vector<int> met;
    std::size_t k = first;
    for (; k < pairs.size() && pairs[k][0] == pairs[first][0]; ++k)
      met.push_back(cells.indices[at(pairs[k][1])]);
    find_vertex_contacts(with_vertex, vertices.indices[at(pairs[first][0])], with_cell, met, vertex_of_a,
                         limits, contacts);
    first = k;
  }
}

/// Not inlined, so that nothing of it is moved across the change of the rounding mode.
[[gnu::noinline]] PairContacts find_contacts_rounding_to_nearest(const PlacedSurface& a,
                                                                 const PlacedSurface& b,
                                                                 const ContactLimits& limits) {
  PairContacts contacts;
  const double margin = std::max(limits.reach, limits.penetration);
  if (!a.box().grown(margin).meets(b.box())) return contacts;
  // Only one of two boxes is grown, so that features meet when nearer than the margin.
  const NearFeatures cells_a = near_cells(a, b.box(), margin);
  const NearFeatures cells_b = near_cells(b, a.box().grown(margin), 0.0);
  const double cosine = std::cos(limits.angle);
  for (const auto& [i, j] : meeting_boxes(cells_a.boxes, cells_b.boxes)) {
    const int cell_a = cells_a.indices[at(i)];
    const int cell_b = cells_b.indices[at(j)];
    if (a.normal(cell_a).dot(b.normal(cell_b)) > -cosine) continue;
    auto overlap = overlap_of_cells(a, cell_a, b, cell_b, limits, contacts.counts);
    if (overlap) contacts.overlaps.push_back(std::move(*overlap));
  }
  find_all_vertex_contacts(a, near_vertices(a, b.box(), margin), b, cells_b, true, limits, contacts);
  find_all_vertex_contacts(b, near_vertices(b, a.box().grown(margin), 0.0), a, cells_a, false, limits,
                           contacts);
  const NearFeatures edges_a = near_edges(a, b.box(), margin);
  const NearFeatures edges_b = near_edges(b, a.box().grown(margin), 0.0);
  for (const auto& [i, j] : meeting_boxes(edges_a.boxes, edges_b.boxes)) {
    if (auto contact =
            edge_contact(a, edges_a.indices[at(i)], b, edges_b.indices[at(j)], limits, contacts.counts))
      contacts.edges.push_back(*contact);
  }
  return contacts;
}

}  // namespace

double tributary_area(const SubFaceSurface& surface, const std::vector<int>& cells) {
  double sum = 0.0;
  for (const int cell : cells) sum += surface.face_share[at(surface.cells[at(cell)].face)];
  return sum / static_cast<double>(cells.size());
}

PairContacts find_contacts(const PlacedSurface& a, const PlacedSurface& b, const ContactLimits& limits) {
  const NearestRounding rounding;
  return find_contacts_rounding_to_nearest(a, b, limits);
}

}  // namespace ashlar

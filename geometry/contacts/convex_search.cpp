#include "geometry/contacts/convex_search.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/rounding_mode.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

TriangleMesh triangles_of(const PlacedSurface& s) {
  TriangleMesh mesh;
  mesh.points = s.points();
  for (const SurfaceCell& cell : s.surface().cells)
    for (std::size_t k = 1; k + 1 < cell.corners.size(); ++k)
      mesh.triangles.push_back({cell.corners[0], cell.corners[k], cell.corners[k + 1]});
  return mesh;
}

bool contains(const std::vector<int>& list, int value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// Height of a point of one surface over the plane of a cell of another, m.
double gap_over(const PlacedSurface& with_point, int point, const PlacedSurface& with_cell, int cell) {
  const Vector3& in_plane = with_cell.point(with_cell.surface().cells[at(cell)].corners[0]);
  return with_cell.normal(cell).dot(with_point.point(point) - in_plane);
}

/// The first of some lists with most of the given points.
template <class ListOf>
int most_in_common(const std::vector<int>& points, int count, ListOf list_of) {
  int best = 0;
  std::ptrdiff_t most = -1;
  for (int k = 0; k < count; ++k) {
    const std::vector<int> list = list_of(k);
    const auto common =
        std::count_if(points.begin(), points.end(), [&](int point) { return contains(list, point); });
    if (common > most) {
      most = common;
      best = k;
    }
  }
  return best;
}

EntranceName name_of(const Entrance& entrance, const ConvexSurface& a, const ConvexSurface& b) {
  EntranceName name{entrance.kind, {-1, -1}, {-1, -1}, entrance.reversed};
  const auto ends = [](const ConvexSurface& s, int edge) {
    const auto& [from, to] = s.shape().edges()[at(edge)].corners;
    return std::array<int, 2>{s.shape().source_points()[at(from)], s.shape().source_points()[at(to)]};
  };
  switch (entrance.kind) {
    case EntranceKind::face_of_a:
      name.a[0] = a.cell_of_facet(entrance.a);
      break;
    case EntranceKind::face_of_b:
      name.b[0] = b.cell_of_facet(entrance.b);
      break;
    case EntranceKind::edge_edge:
      name.a = ends(a, entrance.a);
      name.b = ends(b, entrance.b);
  }
  return name;
}

std::optional<Entrance> entrance_of(const EntranceName& name, const ConvexSurface& a,
                                    const ConvexSurface& b) {
  Entrance entrance{name.kind, -1, -1, name.reversed};
  bool reversed_a = false;
  bool reversed_b = false;
  switch (name.kind) {
    case EntranceKind::face_of_a:
      entrance.a = a.facet_of_cell(name.a[0]);
      return entrance;
    case EntranceKind::face_of_b:
      entrance.b = b.facet_of_cell(name.b[0]);
      return entrance;
    case EntranceKind::edge_edge:
      entrance.a = a.find_edge(name.a, reversed_a);
      entrance.b = b.find_edge(name.b, reversed_b);
      entrance.reversed ^= reversed_a != reversed_b;
      return entrance.a < 0 || entrance.b < 0 ? std::nullopt : std::optional(entrance);
  }
  return std::nullopt;
}

/// Converts the exact contact of two hulls to contacts of the surfaces' features.
class ContactMaker {
 public:
  ContactMaker(const ConvexSurface& a, const ConvexSurface& b, const ResolvedContact& exact,
               PairContacts& contacts)
      : a_(a), b_(b), exact_(exact), contacts_(contacts) {}

  void make() {
    const ContactRegion& region = exact_.region;
    if (region.dimension == 2) {
      auto overlap = overlap_of_cells(a_.placed(), a_.cell_of_facet(region.a.index), b_.placed(),
                                      b_.cell_of_facet(region.b.index), contacts_.counts);
      if (overlap) contacts_.overlaps.push_back(std::move(*overlap));
      return;
    }
    for (const RegionVertex& point : region.points) {
      if (point.a.dimension == 0 && point.b.dimension == 2) {
        add_vertex(a_, point.a.index, b_, point.b.index, true);
      } else if (point.b.dimension == 0 && point.a.dimension == 2) {
        add_vertex(b_, point.b.index, a_, point.a.index, false);
      } else {
        add_crossing(point);
      }
    }
  }

  /// Adds a corner on a corner or an edge that has entered through a face. @return true if the contact is of this
  /// kind
  bool make_corner_over(const Entrance& entrance) {
    const RegionVertex& point = exact_.region.points.front();
    const bool vertex_of_a = entrance.kind == EntranceKind::face_of_b;
    if (entrance.kind == EntranceKind::edge_edge || exact_.region.points.size() != 1 ||
        (vertex_of_a ? point.a : point.b).dimension != 0)
      return false;
    contacts_.vertices.clear();
    contacts_.edges.clear();
    if (vertex_of_a) {
      add_vertex(a_, point.a.index, b_, entrance.b, true);
    } else {
      add_vertex(b_, point.b.index, a_, entrance.a, false);
    }
    return true;
  }

 private:
  void add_vertex(const ConvexSurface& with_vertex, int corner, const ConvexSurface& with_cell, int facet,
                  bool vertex_of_a) {
    const int point = with_vertex.shape().source_points()[at(corner)];
    const int cell = with_cell.cell_of_facet(facet);
    const SubFaceSurface& surface = with_vertex.placed().surface();
    const SurfaceVertex& vertex = surface.vertices[at(surface.vertex_of_point[at(point)])];
    contacts_.vertices.push_back({vertex_of_a, point, vertex.cells.front(), cell,
                                  gap_over(with_vertex.placed(), point, with_cell.placed(), cell),
                                  tributary_area(surface, vertex.cells)});
  }

  struct Side {
    CrossedSide side;
    double area;
  };

  /// A corner is a side without length.
  static Side side_of(const ConvexSurface& s, const ContactFeature& feature, const Vector3& place) {
    const std::vector<int>& source = s.shape().source_points();
    std::vector<int> points;
    if (feature.dimension == 1) {
      const auto& [from, to] = s.shape().edges()[at(feature.index)].corners;
      points = {source[at(from)], source[at(to)]};
    } else {
      points = {source[at(feature.index)]};
    }
    const auto& all = s.placed().surface().cells;
    std::vector<int> cells;
    for (int cell = 0; cell < static_cast<int>(all.size()); ++cell) {
      const auto& corners = all[at(cell)].corners;
      if (std::all_of(points.begin(), points.end(), [&](int point) { return contains(corners, point); }))
        cells.push_back(cell);
    }
    // An edge that rounding has made across a face is in no cell; its first end is.
    if (cells.empty()) return side_of(s, {0, s.shape().edges()[at(feature.index)].corners[0]}, place);
    const double area = tributary_area(s.placed().surface(), cells);
    if (points.size() == 1) return {{{points[0], points[0]}, cells[0], 0.0}, area};
    const Vector3 along = s.placed().point(points[1]) - s.placed().point(points[0]);
    const double share = along.dot(place - s.placed().point(points[0])) / along.squaredNorm();
    return {{{points[0], points[1]}, cells[0], std::clamp(share, 0.0, 1.0)}, area};
  }

  void add_crossing(const RegionVertex& point) {
    const Side on_a = side_of(a_, point.a, point.on_a);
    const Side on_b = side_of(b_, point.b, point.on_b);
    contacts_.edges.push_back({on_a.side, on_b.side, exact_.normal,
                               exact_.normal.dot(point.on_a - point.on_b), std::min(on_a.area, on_b.area)});
  }

  const ConvexSurface& a_;
  const ConvexSurface& b_;
  const ResolvedContact& exact_;
  PairContacts& contacts_;
};

/// A vertex inside the block has entered through the face of the entrance if it is below it, not through adjacent
/// ones: one contact.
void turn_to_entrance(const ConvexSurface& a, const ConvexSurface& b, const EntranceName& entrance,
                      PairContacts& contacts) {
  if (entrance.kind == EntranceKind::edge_edge) return;
  const bool face_of_b = entrance.kind == EntranceKind::face_of_b;
  const PlacedSurface& with_vertex = (face_of_b ? a : b).placed();
  const PlacedSurface& with_cell = (face_of_b ? b : a).placed();
  const int cell = face_of_b ? entrance.b[0] : entrance.a[0];
  const auto& cells = with_cell.surface().cells;
  const auto around = [&](const VertexContact& contact) {
    const std::vector<int>& corners = cells[at(contact.cell)].corners;
    return contact.vertex_of_a == face_of_b && std::any_of(corners.begin(), corners.end(), [&](int corner) {
             return contains(cells[at(cell)].corners, corner);
           });
  };
  std::vector<VertexContact> kept;
  std::vector<int> turned;  // vertices
  for (const VertexContact& contact : contacts.vertices) {
    kept.push_back(contact);
    if (!around(contact) || contact.gap >= 0.0) continue;
    const double gap = gap_over(with_vertex, contact.point, with_cell, cell);
    if (gap >= 0.0 ||
        !is_over_cell(with_vertex, with_vertex.point(contact.point), with_cell, cell, contacts.counts))
      continue;
    if (contains(turned, contact.point)) {
      kept.pop_back();
      continue;
    }
    turned.push_back(contact.point);
    kept.back().cell = cell;
    kept.back().gap = gap;
  }
  contacts.vertices = std::move(kept);
}

/// Not inlined, so that no arithmetic is moved across the change of the rounding mode.
[[gnu::noinline]] std::optional<EntranceName> settle_rounding_to_nearest(const ConvexSurface& a,
                                                                         const ConvexSurface& b,
                                                                         const ContactHistory& history,
                                                                         PairContacts& contacts) {
  std::optional<Entrance> known;
  if (history.entrance) known = entrance_of(*history.entrance, a, b);
  ResolvedContact exact = classify_at(a.shape(), b.shape(), {}, known);
  if (exact.rule == DirectionRule::history && exact.gap < -history.depth)
    exact = classify_at(a.shape(), b.shape(), {});
  contacts.type = exact.region.type;
  contacts.counts.filter += exact.decided_by.filter;
  contacts.counts.exact += exact.decided_by.exact;
  const bool touching = exact.relation == Relation::touching;
  if (contacts.empty() && (touching ? 0.0 : std::abs(exact.gap)) < history.rounding) return history.entrance;
  const bool crossing = exact.relation == Relation::crossing;
  const std::optional<Entrance> entrance =
      crossing ? exact.entrance : find_entrance(a.shape(), b.shape(), known);
  if (!entrance) return std::nullopt;
  const EntranceName name = name_of(*entrance, a, b);
  ContactMaker maker(a, b, exact, contacts);
  if (!crossing) {
    // Collinear edges are no features that face each other, but can transmit forces.
    if (touching && contacts.empty()) maker.make();
    return name;
  }
  const bool corner_alone =
      exact.region.type == ContactType::vertex_vertex || exact.region.type == ContactType::vertex_edge;
  if (corner_alone && maker.make_corner_over(*entrance)) return name;
  if (contacts.empty()) maker.make();
  turn_to_entrance(a, b, name, contacts);
  return name;
}

}  // namespace

ConvexSurface::ConvexSurface(const PlacedSurface& surface)
    : placed_(&surface), shape_(ConvexShape::hull_of(triangles_of(surface))) {}

std::vector<int> ConvexSurface::points_of_facet(int facet) const {
  std::vector<int> points;
  for (const int corner : shape_.facet(facet)) points.push_back(shape_.source_points()[at(corner)]);
  return points;
}

int ConvexSurface::cell_of_facet(int facet) const {
  const auto& cells = placed_->surface().cells;
  return most_in_common(points_of_facet(facet), static_cast<int>(cells.size()),
                        [&](int cell) { return cells[at(cell)].corners; });
}

int ConvexSurface::facet_of_cell(int cell) const {
  return most_in_common(placed_->surface().cells[at(cell)].corners, shape_.facet_count(),
                        [&](int facet) { return points_of_facet(facet); });
}

int ConvexSurface::find_edge(const std::array<int, 2>& points, bool& reversed) const {
  const std::vector<int>& source = shape_.source_points();
  for (int edge = 0; edge < static_cast<int>(shape_.edges().size()); ++edge) {
    const auto& [from, to] = shape_.edges()[at(edge)].corners;
    const std::array<int, 2> ends = {source[at(from)], source[at(to)]};
    reversed = ends != points;
    if (!reversed || (ends[0] == points[1] && ends[1] == points[0])) return edge;
  }
  return -1;
}

std::optional<EntranceName> settle_convex_contacts(const ConvexSurface& a, const ConvexSurface& b,
                                                   const ContactHistory& history, PairContacts& contacts) {
  const NearestRounding nearest;
  return settle_rounding_to_nearest(a, b, history, contacts);
}

EntranceName entrance_of_faces(const CellOverlap& overlap) {
  return {EntranceKind::face_of_b, {-1, -1}, {overlap.cell_b, -1}, false};
}

}  // namespace ashlar

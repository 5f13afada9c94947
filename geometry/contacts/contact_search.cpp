#include "geometry/contacts/contact_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/contacts/feature_boxes.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "geometry/exact/rounding_mode.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// @param chord bounds of both cells, m
bool within_limits(double gap, double chord, const ContactLimits& limits) {
  return gap <= limits.reach + chord && gap >= -std::min(limits.penetration + chord, limits.deepest);
}

bool within_limits(const PlacedSurface& a, const PlacedSurface& b, const CellOverlap& overlap,
                   const ContactLimits& limits) {
  const double least = *std::min_element(overlap.gaps.begin(), overlap.gaps.end());
  const double chord = a.chord_bound(overlap.cell_a) + b.chord_bound(overlap.cell_b);
  return within_limits(least, chord, limits);
}

/// True if any cell of a list faces the opposite of a direction within the angle.
bool any_facing(const PlacedSurface& s, const std::vector<int>& cells, const Vector3& normal, double cosine) {
  return std::any_of(cells.begin(), cells.end(),
                     [&](int cell) { return s.normal(cell).dot(normal) <= -cosine; });
}

/// True if a vertex is an end of the block against a normal: no neighbour is deeper than the angle allows, and an
/// adjacent face faces that way.
bool is_end(const PlacedSurface& s, const SurfaceVertex& vertex, const Vector3& normal, double sine) {
  const Vector3& place = s.point(vertex.point);
  for (const int neighbour : vertex.neighbours) {
    const Vector3 side = s.point(neighbour) - place;
    if (normal.dot(side) < -sine * side.norm()) return false;
  }
  return std::any_of(vertex.cells.begin(), vertex.cells.end(),
                     [&](int cell) { return s.normal(cell).dot(normal) < 0.0; });
}

bool across_convex_edge(const SubFaceSurface& surface, int face_a, int face_b) {
  const auto& neighbours = surface.convex_neighbours[at(face_a)];
  return face_a == face_b || std::binary_search(neighbours.begin(), neighbours.end(), face_b);
}

/// A cell below a vertex, or below its extension beyond edges of its face.
struct CellBelow {
  int cell;
  double gap;             ///< m
  std::vector<int> past;  ///< sides beyond which the vertex is
  bool hidden;            ///< true if the face lies on a third block there
};

/// Where a block's face lies on a third block.
using Hides = OccludedPlaces::Hides;

/// Vertices of one surface over the cells of the other one.
struct VertexSearch {
  const PlacedSurface& with_vertex;
  const PlacedSurface& with_cell;
  bool vertex_of_a;
  const ContactLimits& limits;
  const Hides& hides;
};

/// Cells of one block near a vertex of the other, below it or below the extension beyond edges of their faces.
std::vector<CellBelow> near_below(const VertexSearch& search, const Vector3& place,
                                  const std::vector<int>& cells, DecisionCounts& counts) {
  const auto& [with_vertex, with_cell, vertex_of_a, limits, hides] = search;
  std::vector<CellBelow> near;
  for (const int cell : cells) {
    const SurfaceCell& sides = with_cell.surface().cells[at(cell)];
    const Vector3& normal = with_cell.normal(cell);
    const double gap = normal.dot(place - with_cell.point(sides.corners[0]));
    if (!within_limits(gap, with_cell.chord_bound(cell), limits)) continue;
    PlaceOverCell over =
        place_over_cell(with_vertex, place, with_cell, cell, static_cast<bool>(hides), counts);
    if (!over.over) continue;
    const bool hidden = hides && over.past.empty() && hides(sides.face, place - gap * normal);
    near.push_back({cell, gap, std::move(over.past), hidden});
  }
  return near;
}

/// The cells that bound the block at the vertex. Below a reflex edge a cell's half space extends under the adjacent
/// face, and it extends behind an occluded face too: it counts there if that face is near as well.
std::vector<CellBelow> bounding_cells(const PlacedSurface& with_cell, const std::vector<CellBelow>& near) {
  std::vector<CellBelow> bounding;
  for (const CellBelow& one : near) {
    const SurfaceCell& sides = with_cell.surface().cells[at(one.cell)];
    const bool bounds = std::all_of(one.past.begin(), one.past.end(), [&](int side) {
      return std::any_of(near.begin(), near.end(), [&](const CellBelow& other) {
        return with_cell.surface().cells[at(other.cell)].face == sides.across[at(side)] &&
               (sides.reflex[at(side)] || (other.hidden && other.gap < 0.0));
      });
    });
    if (bounds) bounding.push_back(one);
  }
  // A point outside of a face is outside of the solid as far as adjacent faces are joined by convex edges.
  const auto is_beside = [&](const CellBelow& one) {
    return one.gap < 0.0 && std::any_of(near.begin(), near.end(), [&](const CellBelow& other) {
             return other.past.empty() && other.gap > with_cell.chord_bound(other.cell) &&
                    across_convex_edge(with_cell.surface(), with_cell.surface().cells[at(one.cell)].face,
                                       with_cell.surface().cells[at(other.cell)].face);
           });
  };
  std::erase_if(bounding, is_beside);
  return bounding;
}

/// Contacts of a vertex of one block with cells of the other.
void find_vertex_contacts(const VertexSearch& search, int vertex_index, const std::vector<int>& cells,
                          PairContacts& contacts) {
  const PlacedSurface& with_vertex = search.with_vertex;
  const PlacedSurface& with_cell = search.with_cell;
  const ContactLimits& limits = search.limits;
  const double cosine = limits.angle.cosine();
  const double sine = limits.angle.sine();
  const SurfaceVertex& vertex = with_vertex.surface().vertices[at(vertex_index)];
  const Vector3& place = with_vertex.point(vertex.point);
  std::vector<CellBelow> found = bounding_cells(with_cell, near_below(search, place, cells, contacts.counts));
  std::erase_if(found, [&](const CellBelow& below) {
    const Vector3& normal = with_cell.normal(below.cell);
    return !is_end(with_vertex, vertex, normal, sine) ||
           any_facing(with_vertex, vertex.cells, normal, cosine);
  });
  // A vertex has entered through one of the faces that share a convex edge only: where it is least deep. It must stay
  // outside of all faces that share a reflex edge.
  std::stable_sort(found.begin(), found.end(), [](const CellBelow& p, const CellBelow& q) {
    return p.hidden != q.hidden ? q.hidden : p.gap > q.gap;
  });
  const auto face_of = [&](const CellBelow& below) { return with_cell.surface().cells[at(below.cell)].face; };
  std::vector<CellBelow> kept;
  for (CellBelow& below : found) {
    const bool repeated = std::any_of(kept.begin(), kept.end(), [&](const CellBelow& other) {
      return across_convex_edge(with_cell.surface(), face_of(below), face_of(other));
    });
    if (!repeated) kept.push_back(std::move(below));
  }
  const double area = kept.empty() ? 0.0 : tributary_area(with_vertex.surface(), vertex.cells);
  for (const CellBelow& below : kept)
    contacts.vertices.push_back(
        {search.vertex_of_a, vertex.point, vertex.cells.front(), below.cell, below.gap, area});
}

/// True if the block is behind its edge as seen from the tip of the normal: both cells lean away from `outward`.
bool edge_is_end(const PlacedSurface& s, const SurfaceEdge& edge, const Vector3& outward, double sine) {
  const Vector3 along = (s.point(edge.ends[1]) - s.point(edge.ends[0])).normalized();
  // The edge runs counter-clockwise on its left cell, whose inside is to the left of it seen from outside.
  const Vector3 into_left = s.normal(edge.cells[0]).cross(along);
  const Vector3 into_right = along.cross(s.normal(edge.cells[1]));
  return outward.dot(into_left) <= sine && outward.dot(into_right) <= sine;
}

/// Place of a crossing on one of two edges in the projection along their common normal: within it, or at or beyond an
/// end at which a reflex edge of the block ends too. There the surface continues with another edge, and below both of
/// them each bounds the block.
struct PlaceOnEdge {
  bool counts = false;
  int beyond = -1;  ///< the point of the end, -1: within the edge
};

/// @param start,end sides of the other edge's line on which the ends are. @param along rounded place of the crossing
PlaceOnEdge place_on_edge(const PlacedSurface& s, const SurfaceEdge& edge, int start, int end, double along) {
  if (start * end < 0) return {true, -1};
  const bool at_start = start == 0 || (end != 0 && along < 0.5);
  const int point = edge.ends[at_start ? 0 : 1];
  return {s.surface().vertices[at(s.surface().vertex_of_point[at(point)])].reflex, point};
}

/// Two edges that cross, or whose extensions beyond their ends do.
struct EdgeCrossing {
  EdgeContact contact;
  int beyond_a = -1;  ///< point of a at or beyond which it crosses, -1: within the edge
  int beyond_b = -1;
};

std::optional<EdgeCrossing> edge_crossing(const PlacedSurface& a, int edge_a, const PlacedSurface& b,
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
  const double sine = limits.angle.sine();
  // Edges that stay within reach of each other along the shorter one are treated as parallel.
  if (normal.norm() <= std::min(sine * u.norm() * v.norm(), limits.reach * std::max(u.norm(), v.norm())))
    return std::nullopt;
  const double squared = normal.squaredNorm();
  // Seen along the normal the edges cross at a0 + s u = b0 + t v (+ gap along the normal).
  double s = v.cross(r).dot(normal) / squared;
  double t = u.cross(r).dot(normal) / squared;
  normal /= std::sqrt(squared);
  // Out of b: the side faced by the faces of b.
  const Vector3 out_of_b = b.normal(eb.cells[0]) + b.normal(eb.cells[1]);
  if (normal.dot(out_of_b) < 0.0) normal = -normal;
  const double gap = normal.dot(r);
  if (!within_limits(gap, chord_bound(a, ea) + chord_bound(b, eb), limits)) return std::nullopt;
  if (!edge_is_end(b, eb, normal, sine) || !edge_is_end(a, ea, -normal, sine)) return std::nullopt;
  const std::vector<int> cells_a(ea.cells.begin(), ea.cells.end());
  const std::vector<int> cells_b(eb.cells.begin(), eb.cells.end());
  const double cosine = limits.angle.cosine();
  for (const int cell : cells_b) {
    if (any_facing(a, cells_a, b.normal(cell), cosine)) return std::nullopt;
  }
  PredicateLadder ladder{within_range(a, b, Vector3::Zero()), counts};
  const ContactDirection w = ContactDirection::cross({&ends_a[1], &ends_a[0]}, {&ends_b[1], &ends_b[0]});
  const SideOfLine of_b(w, ends_b[0], ends_b[1]);
  const PlaceOnEdge on_a =
      place_on_edge(a, ea, of_b.sign(ends_a[0], ladder), of_b.sign(ends_a[1], ladder), s);
  PlaceOnEdge on_b;
  if (on_a.counts) {
    const SideOfLine of_a(w, ends_a[0], ends_a[1]);
    on_b = place_on_edge(b, eb, of_a.sign(ends_b[0], ladder), of_a.sign(ends_b[1], ladder), t);
  }
  counts = ladder.counts;
  if (!on_b.counts) return std::nullopt;
  if (on_a.beyond < 0) s = std::clamp(s, 0.0, 1.0);
  if (on_b.beyond < 0) t = std::clamp(t, 0.0, 1.0);
  const double area = std::min(tributary_area(a.surface(), cells_a), tributary_area(b.surface(), cells_b));
  return EdgeCrossing{
      {{ea.ends, ea.cells[0], s}, {eb.ends, eb.cells[0], t}, normal, gap, area}, on_a.beyond, on_b.beyond};
}

/// True if another edge of the same block that ends at a point crosses too.
bool may_continue(const std::vector<EdgeCrossing>& crossings, CrossedSide EdgeContact::*side,
                  const EdgeCrossing& one, int point) {
  return point < 0 || std::any_of(crossings.begin(), crossings.end(), [&](const EdgeCrossing& other) {
           const auto& ends = (other.contact.*side).ends;
           return ends != (one.contact.*side).ends && (ends[0] == point || ends[1] == point);
         });
}

/// Adds crossings within both edges, and those beyond ends where the surfaces continue with other crossing edges.
void add_crossings(const std::vector<EdgeCrossing>& crossings, PairContacts& contacts) {
  for (const EdgeCrossing& one : crossings) {
    if (may_continue(crossings, &EdgeContact::of_a, one, one.beyond_a) &&
        may_continue(crossings, &EdgeContact::of_b, one, one.beyond_b))
      contacts.edges.push_back(one.contact);
  }
}

/// All vertices of one block against cells of the other.
void find_all_vertex_contacts(const VertexSearch& search, const IndexedBoxes& vertices,
                              const IndexedBoxes& cells, PairContacts& contacts) {
  const auto pairs = meeting_boxes(vertices.boxes, cells.boxes);
  for (std::size_t first = 0; first < pairs.size();) {
    std::vector<int> met;
    std::size_t k = first;
    for (; k < pairs.size() && pairs[k][0] == pairs[first][0]; ++k)
      met.push_back(cells.indices[at(pairs[k][1])]);
    find_vertex_contacts(search, vertices.indices[at(pairs[first][0])], met, contacts);
    first = k;
  }
}

/// Not inlined, so that no arithmetic is moved across the change of the rounding mode.
[[gnu::noinline]] PairContacts find_contacts_rounding_to_nearest(const PlacedSurface& a,
                                                                 const PlacedSurface& b,
                                                                 const ContactLimits& limits,
                                                                 const OccludedPlaces& hidden) {
  PairContacts contacts;
  const double margin = std::max(limits.reach, limits.penetration);
  if (!a.box().grown(margin).meets(b.box())) return contacts;
  // Only one of two boxes is grown, so that features closer than the margin are found.
  const FeaturesNear of_a(a, b.box(), margin), of_b(b, a.box().grown(margin), 0.0);
  const IndexedBoxes cells_a = of_a.cells();
  const IndexedBoxes cells_b = of_b.cells();
  contacts.cells_near = static_cast<long>(cells_a.indices.size() + cells_b.indices.size());
  const double cosine = limits.angle.cosine();
  for (const auto& [i, j] : meeting_boxes(cells_a.boxes, cells_b.boxes)) {
    const int cell_a = cells_a.indices[at(i)];
    const int cell_b = cells_b.indices[at(j)];
    if (a.normal(cell_a).dot(b.normal(cell_b)) > -cosine) continue;
    auto overlap = overlap_of_cells(a, cell_a, b, cell_b, contacts.counts);
    if (overlap && within_limits(a, b, *overlap, limits)) contacts.overlaps.push_back(std::move(*overlap));
  }
  find_all_vertex_contacts({a, b, true, limits, hidden.of_b}, of_a.vertices(), cells_b, contacts);
  find_all_vertex_contacts({b, a, false, limits, hidden.of_a}, of_b.vertices(), cells_a, contacts);
  const IndexedBoxes edges_a = of_a.edges();
  const IndexedBoxes edges_b = of_b.edges();
  std::vector<EdgeCrossing> crossings;
  for (const auto& [i, j] : meeting_boxes(edges_a.boxes, edges_b.boxes)) {
    if (auto crossing =
            edge_crossing(a, edges_a.indices[at(i)], b, edges_b.indices[at(j)], limits, contacts.counts))
      crossings.push_back(*crossing);
  }
  add_crossings(crossings, contacts);
  return contacts;
}

}  // namespace

ContactAngle::ContactAngle(double angle)
    : cosine_(correctly_rounded::cos(angle)), sine_(correctly_rounded::sin(angle)) {}

double tributary_area(const SubFaceSurface& surface, const std::vector<int>& cells) {
  std::set<int> faces;
  for (const int cell : cells) faces.insert(surface.cells[at(cell)].face);
  double sum = 0.0;
  for (const int face : faces) sum += surface.face_share[at(face)];
  return sum / static_cast<double>(faces.size());
}

PairContacts find_contacts(const PlacedSurface& a, const PlacedSurface& b, const ContactLimits& limits,
                           const OccludedPlaces* hidden) {
  const NearestRounding rounding;
  return find_contacts_rounding_to_nearest(a, b, limits, hidden == nullptr ? OccludedPlaces{} : *hidden);
}

}  // namespace ashlar

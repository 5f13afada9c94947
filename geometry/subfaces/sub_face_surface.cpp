#include "geometry/subfaces/sub_face_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "geometry/solid/half_edges.hpp"

namespace ashlar {
namespace {

/// Splits every triangle into four; shared sides get one midpoint.
void split(std::vector<Vector3>& points, std::vector<SurfaceCell>& cells) {
  std::map<std::pair<int, int>, int> midpoints;
  const auto midpoint = [&](int a, int b) {
    const auto [place, added] = midpoints.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
    if (added) points.emplace_back(0.5 * (points[at(a)] + points[at(b)]));
    return place->second;
  };
  std::vector<SurfaceCell> children;
  children.reserve(4 * cells.size());
  for (const SurfaceCell& cell : cells) {
    const auto [a, b, c] = std::array{cell.corners[0], cell.corners[1], cell.corners[2]};
    const auto [rim_ab, rim_bc, rim_ca] = std::array{cell.rim[0], cell.rim[1], cell.rim[2]};
    const int ab = midpoint(a, b);
    const int bc = midpoint(b, c);
    const int ca = midpoint(c, a);
    children.push_back({cell.face, {a, ab, ca}, {rim_ab, -1, rim_ca}});
    children.push_back({cell.face, {ab, b, bc}, {rim_ab, rim_bc, -1}});
    children.push_back({cell.face, {ca, bc, c}, {-1, rim_bc, rim_ca}});
    children.push_back({cell.face, {ab, bc, ca}, {-1, -1, -1}});
  }
  cells = std::move(children);
}

/// Area of each face over its number of corners.
std::vector<double> face_shares(const Polyhedron& solid) {
  std::vector<double> shares;
  for (const PolyhedronFace& face : solid.faces()) {
    double area = 0.0;
    for (const int t : face.triangles) {
      const auto& [a, b, c] = solid.mesh().triangles[at(t)];
      const auto& points = solid.mesh().points;
      area += 0.5 * (points[at(b)] - points[at(a)]).cross(points[at(c)] - points[at(a)]).norm();
    }
    std::size_t corners = 0;
    for (const auto& loop : face.loops) corners += loop.size();
    shares.push_back(area / static_cast<double>(corners));
  }
  return shares;
}

std::vector<std::vector<int>> convex_neighbours(const Polyhedron& solid) {
  std::vector<std::set<int>> neighbours(solid.faces().size());
  for (const PolyhedronEdge& edge : solid.edges()) {
    if (!edge.convex) continue;
    neighbours[at(edge.faces[0])].insert(edge.faces[1]);
    neighbours[at(edge.faces[1])].insert(edge.faces[0]);
  }
  std::vector<std::vector<int>> result;
  result.reserve(neighbours.size());
  for (const auto& set : neighbours) result.emplace_back(set.begin(), set.end());
  return result;
}

void find_neighbours(const Polyhedron& solid, SubFaceSurface& surface) {
  for (SurfaceCell& cell : surface.cells) {
    cell.across.assign(cell.corners.size(), -1);
    cell.reflex.assign(cell.corners.size(), false);
    for (std::size_t k = 0; k < cell.rim.size(); ++k) {
      if (cell.rim[k] < 0) continue;
      const PolyhedronEdge& edge = solid.edges()[at(cell.rim[k])];
      cell.across[k] = edge.faces[0] == cell.face ? edge.faces[1] : edge.faces[0];
      cell.reflex[k] = !edge.convex;
    }
  }
  for (const SurfaceEdge& edge : surface.edges) {
    if (edge.convex) continue;
    for (const int end : edge.ends) surface.vertices[at(surface.vertex_of_point[at(end)])].reflex = true;
  }
}

/// (3 #triangles) The twin of each half-edge. @throws std::invalid_argument if the triangles are not closed
std::vector<int> twins_of_closed(const std::vector<std::array<int, 3>>& triangles, std::size_t point_count) {
  HalfEdges half_edges(triangles, point_count);
  half_edges.add_all();
  std::vector<int> twins = half_edges.twins();
  if (std::find(twins.begin(), twins.end(), -1) != twins.end())
    throw std::invalid_argument("the triangles of a surface must be closed");
  return twins;
}

/// (3 #triangles) The edge of the polyhedron that contains each half-edge of its mesh; -1: none. An edge may be a
/// chain of half-edges over points that are no corners; from such a point a chain has one continuation.
std::vector<int> edges_of_half_edges(const Polyhedron& solid) {
  const auto& triangles = solid.mesh().triangles;
  const std::vector<int> twins = twins_of_closed(triangles, solid.mesh().points.size());
  const auto face_of = [&](int h) { return solid.face_of_triangle()[at(h / 3)]; };
  const auto is_rim = [&](int h) { return face_of(h) != face_of(twins[at(h)]); };
  const auto next_on_rim = [&](int h) {
    h = next_half_edge(h);
    while (!is_rim(h)) h = next_half_edge(twins[at(h)]);
    return h;
  };
  std::vector<bool> is_corner(solid.mesh().points.size(), false);
  for (const int corner : solid.corners()) is_corner[at(corner)] = true;
  std::map<std::array<int, 3>, int> edge_between;  // by left face and corners
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const PolyhedronEdge& edge = solid.edges()[e];
    edge_between[{edge.faces[0], edge.vertices[0], edge.vertices[1]}] = static_cast<int>(e);
  }
  std::vector<int> edges(twins.size(), -1);
  for (int first = 0; first < static_cast<int>(twins.size()); ++first) {
    const int corner = start_of(triangles, first);
    if (!is_corner[at(corner)] || !is_rim(first)) continue;
    std::vector<int> chain = {first};
    while (!is_corner[at(start_of(triangles, twins[at(chain.back())]))])
      chain.push_back(next_on_rim(chain.back()));
    const auto edge =
        edge_between.find({face_of(first), corner, start_of(triangles, twins[at(chain.back())])});
    if (edge == edge_between.end()) continue;
    for (const int h : chain) edges[at(h)] = edges[at(twins[at(h)])] = edge->second;
  }
  return edges;
}

/// The mesh's triangles of a face as cells.
void add_triangles(const Polyhedron& solid, int face, const std::vector<int>& edges_of_half_edges,
                   std::vector<SurfaceCell>& cells) {
  for (const int t : solid.faces()[at(face)].triangles) {
    const auto& triangle = solid.mesh().triangles[at(t)];
    const auto rim = edges_of_half_edges.begin() + 3 * t;
    cells.push_back({face, {triangle.begin(), triangle.end()}, {rim, rim + 3}});
  }
}

void find_edges_of_cells(SubFaceSurface& surface) {
  surface.edges_of.resize(surface.cells.size());
  for (std::size_t e = 0; e < surface.edges.size(); ++e)
    for (const int cell : surface.edges[e].cells) {
      std::vector<int>& edges = surface.edges_of[at(cell)];
      if (edges.empty() || edges.back() != static_cast<int>(e)) edges.push_back(static_cast<int>(e));
    }
}

void find_cells_at_points(SubFaceSurface& surface) {
  surface.cells_at.resize(surface.points.size());
  for (std::size_t c = 0; c < surface.cells.size(); ++c) {
    for (const int point : surface.cells[c].corners)
      surface.cells_at[at(point)].push_back(static_cast<int>(c));
  }
}

void find_vertices(SubFaceSurface& surface) {
  surface.vertex_of_point.assign(surface.points.size(), -1);
  for (const SurfaceEdge& edge : surface.edges) {
    for (const int end : edge.ends) surface.vertex_of_point[at(end)] = 0;
  }
  for (std::size_t point = 0; point < surface.points.size(); ++point) {
    if (surface.vertex_of_point[point] < 0) continue;
    surface.vertex_of_point[point] = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back({static_cast<int>(point), {}, {}});
  }
  const auto vertex_at = [&](int point) -> SurfaceVertex* {
    const int vertex = surface.vertex_of_point[at(point)];
    return vertex < 0 ? nullptr : &surface.vertices[at(vertex)];
  };
  for (const SurfaceEdge& edge : surface.edges) {
    vertex_at(edge.ends[0])->neighbours.push_back(edge.ends[1]);
    vertex_at(edge.ends[1])->neighbours.push_back(edge.ends[0]);
  }
  for (const SurfaceCell& cell : surface.cells) {
    const auto& corners = cell.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      SurfaceVertex* vertex = vertex_at(corners[k]);
      if (vertex == nullptr) continue;
      vertex->neighbours.push_back(corners[(k + 1) % corners.size()]);
      vertex->neighbours.push_back(corners[(k + corners.size() - 1) % corners.size()]);
    }
  }
  for (SurfaceVertex& vertex : surface.vertices) {
    vertex.cells = surface.cells_at[at(vertex.point)];
    std::sort(vertex.neighbours.begin(), vertex.neighbours.end());
    vertex.neighbours.erase(std::unique(vertex.neighbours.begin(), vertex.neighbours.end()),
                            vertex.neighbours.end());
  }
}

/// Edges of the polyhedron between whole faces, with any cell of each face that touches the edge.
void take_edges_of_polyhedron(const Polyhedron& solid, SubFaceSurface& surface) {
  const auto cell_at = [&](int point, int face) {
    for (const int cell : surface.cells_at[at(point)]) {
      if (surface.cells[at(cell)].face == face) return cell;
    }
    throw std::logic_error("an edge's end belongs to no cell of its face");
  };
  for (const PolyhedronEdge& edge : solid.edges()) {
    surface.edges.push_back(
        {edge.vertices,
         {cell_at(edge.vertices[0], edge.faces[0]), cell_at(edge.vertices[0], edge.faces[1])},
         edge.convex});
  }
}

}  // namespace

SubFaceSurface whole_surface(const Polyhedron& solid) {
  SubFaceSurface surface;
  surface.points = solid.mesh().points;
  std::map<std::pair<int, int>, int> edge_of_side;
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const auto& [start, end] = solid.edges()[e].vertices;
    edge_of_side[std::minmax(start, end)] = static_cast<int>(e);
  }
  const std::vector<int> rims = edges_of_half_edges(solid);
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    const PolyhedronFace& face = solid.faces()[f];
    if (!face.convex) {
      add_triangles(solid, static_cast<int>(f), rims, surface.cells);
      continue;
    }
    const auto& loop = face.loops.front();
    SurfaceCell cell{static_cast<int>(f), loop, {}};
    for (std::size_t k = 0; k < loop.size(); ++k)
      cell.rim.push_back(edge_of_side.at(std::minmax(loop[k], loop[(k + 1) % loop.size()])));
    surface.cells.push_back(std::move(cell));
  }
  find_cells_at_points(surface);
  take_edges_of_polyhedron(solid, surface);
  find_vertices(surface);
  find_edges_of_cells(surface);
  surface.face_share = face_shares(solid);
  surface.convex_neighbours = convex_neighbours(solid);
  find_neighbours(solid, surface);
  return surface;
}

SubFaceSurface divide_surface(const Polyhedron& solid, int levels) {
  if (levels < 0 || levels > 8) throw std::invalid_argument("levels of subdivision must be 0 to 8");
  std::vector<Vector3> points = solid.mesh().points;
  std::vector<SurfaceCell> cells;
  const std::vector<int> rims = edges_of_half_edges(solid);
  for (std::size_t f = 0; f < solid.faces().size(); ++f)
    add_triangles(solid, static_cast<int>(f), rims, cells);
  for (int level = 0; level < levels; ++level) split(points, cells);
  return surface_of_triangles(solid, points, std::move(cells));
}

SubFaceSurface surface_of_triangles(const Polyhedron& solid, const std::vector<Vector3>& points,
                                    std::vector<SurfaceCell> cells) {
  SubFaceSurface surface;
  surface.divided = true;
  std::vector<int> place(points.size(), -1);
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(cells.size());
  for (SurfaceCell& cell : cells) {
    for (int& corner : cell.corners) {
      const auto given = at(corner);
      if (place[given] < 0) {
        place[given] = static_cast<int>(surface.points.size());
        surface.points.push_back(points[given]);
      }
      corner = place[given];
    }
    triangles.push_back({cell.corners[0], cell.corners[1], cell.corners[2]});
  }
  surface.cells = std::move(cells);
  find_cells_at_points(surface);
  const std::vector<int> twins = twins_of_closed(triangles, surface.points.size());
  for (int h = 0; h < static_cast<int>(twins.size()); ++h) {
    const SurfaceCell& cell = surface.cells[at(h / 3)];
    const int rim = cell.rim[at(h % 3)];
    if (rim < 0) continue;
    const PolyhedronEdge& edge = solid.edges()[at(rim)];
    if (edge.faces[0] != cell.face) continue;
    const int twin = twins[at(h)];
    surface.edges.push_back(
        {{start_of(triangles, h), start_of(triangles, twin)}, {h / 3, twin / 3}, edge.convex});
  }
  find_vertices(surface);
  find_edges_of_cells(surface);
  surface.face_share = face_shares(solid);
  surface.convex_neighbours = convex_neighbours(solid);
  find_neighbours(solid, surface);
  return surface;
}

}  // namespace ashlar

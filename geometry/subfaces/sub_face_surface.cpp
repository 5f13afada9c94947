#include "geometry/subfaces/sub_face_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Side = std::pair<int, int>;

Side sorted(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Splits every triangle into four; shared sides get one midpoint.
void split(std::vector<Vector3>& points, std::vector<SurfaceCell>& cells) {
  std::map<Side, int> midpoints;
  const auto midpoint = [&](int a, int b) {
    const auto [place, added] = midpoints.try_emplace(sorted(a, b), static_cast<int>(points.size()));
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

/// The edge of the polyhedron behind every directed side of a mesh triangle that lies on one. An edge may be
/// a chain of sides with points that are no corners; from such a point a chain has one way to go on.
std::map<Side, int> edges_of_mesh_sides(const Polyhedron& solid) {
  std::map<Side, int> triangle_of_side;
  const auto& triangles = solid.mesh().triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      triangle_of_side[{triangles[t][k], triangles[t][(k + 1) % 3]}] = static_cast<int>(t);
  }
  std::map<std::pair<int, int>, std::vector<int>> next;  // (face, point): ends of its rim sides from there
  for (const auto& [side, triangle] : triangle_of_side) {
    const int face = solid.face_of_triangle()[at(triangle)];
    const int twin = triangle_of_side.at({side.second, side.first});
    if (solid.face_of_triangle()[at(twin)] != face) next[{face, side.first}].push_back(side.second);
  }
  const auto& corners = solid.corners();
  const auto is_corner = [&](int point) { return std::binary_search(corners.begin(), corners.end(), point); };
  std::map<Side, int> edges;
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const PolyhedronEdge& edge = solid.edges()[e];
    for (const int first : next.at({edge.faces[0], edge.vertices[0]})) {
      std::vector<int> chain = {edge.vertices[0], first};
      while (!is_corner(chain.back())) chain.push_back(next.at({edge.faces[0], chain.back()}).front());
      if (chain.back() != edge.vertices[1]) continue;
      for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        edges[{chain[k], chain[k + 1]}] = static_cast<int>(e);
        edges[{chain[k + 1], chain[k]}] = static_cast<int>(e);
      }
    }
  }
  return edges;
}

/// The mesh's triangles of a face as cells.
void add_triangles(const Polyhedron& solid, int face, const std::map<Side, int>& edges_of_sides,
                   std::vector<SurfaceCell>& cells) {
  for (const int t : solid.faces()[at(face)].triangles) {
    const auto& triangle = solid.mesh().triangles[at(t)];
    SurfaceCell cell{face, {triangle.begin(), triangle.end()}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = edges_of_sides.find({triangle[k], triangle[(k + 1) % 3]});
      cell.rim.push_back(edge == edges_of_sides.end() ? -1 : edge->second);
    }
    cells.push_back(std::move(cell));
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
  for (std::size_t c = 0; c < surface.cells.size(); ++c) {
    const auto& corners = surface.cells[c].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      SurfaceVertex* vertex = vertex_at(corners[k]);
      if (vertex == nullptr) continue;
      vertex->cells.push_back(static_cast<int>(c));
      vertex->neighbours.push_back(corners[(k + 1) % corners.size()]);
      vertex->neighbours.push_back(corners[(k + corners.size() - 1) % corners.size()]);
    }
  }
  for (SurfaceVertex& vertex : surface.vertices) {
    std::sort(vertex.neighbours.begin(), vertex.neighbours.end());
    vertex.neighbours.erase(std::unique(vertex.neighbours.begin(), vertex.neighbours.end()),
                            vertex.neighbours.end());
  }
}

/// Edges of the polyhedron between whole faces, with any cell of each face that touches the edge.
void take_edges_of_polyhedron(const Polyhedron& solid, SubFaceSurface& surface) {
  std::vector<std::vector<int>> cells_of_point(surface.points.size());
  for (std::size_t c = 0; c < surface.cells.size(); ++c) {
    for (const int point : surface.cells[c].corners) cells_of_point[at(point)].push_back(static_cast<int>(c));
  }
  const auto cell_at = [&](int point, int face) {
    for (const int cell : cells_of_point[at(point)]) {
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
  std::map<Side, int> edge_of_side;
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    const auto& [start, end] = solid.edges()[e].vertices;
    edge_of_side[sorted(start, end)] = static_cast<int>(e);
  }
  const auto edges_of_sides = edges_of_mesh_sides(solid);
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    const PolyhedronFace& face = solid.faces()[f];
    if (!face.convex) {
      add_triangles(solid, static_cast<int>(f), edges_of_sides, surface.cells);
      continue;
    }
    const auto& loop = face.loops.front();
    SurfaceCell cell{static_cast<int>(f), loop, {}};
    for (std::size_t k = 0; k < loop.size(); ++k)
      cell.rim.push_back(edge_of_side.at(sorted(loop[k], loop[(k + 1) % loop.size()])));
    surface.cells.push_back(std::move(cell));
  }
  take_edges_of_polyhedron(solid, surface);
  find_vertices(surface);
  surface.face_share = face_shares(solid);
  surface.convex_neighbours = convex_neighbours(solid);
  find_neighbours(solid, surface);
  return surface;
}

SubFaceSurface divide_surface(const Polyhedron& solid, int levels) {
  if (levels < 0 || levels > 8) throw std::invalid_argument("levels of subdivision must be 0 to 8");
  std::vector<Vector3> points = solid.mesh().points;
  std::vector<SurfaceCell> cells;
  const auto edges_of_sides = edges_of_mesh_sides(solid);
  for (std::size_t f = 0; f < solid.faces().size(); ++f)
    add_triangles(solid, static_cast<int>(f), edges_of_sides, cells);
  for (int level = 0; level < levels; ++level) split(points, cells);
  return surface_of_triangles(solid, points, std::move(cells));
}

SubFaceSurface surface_of_triangles(const Polyhedron& solid, const std::vector<Vector3>& points,
                                    std::vector<SurfaceCell> cells) {
  SubFaceSurface surface;
  surface.divided = true;
  std::vector<int> place(points.size(), -1);
  std::map<Side, int> right_cell;  // of a side, by the direction the left cell has it in
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (int& corner : cells[c].corners) {
      const auto given = at(corner);
      if (place[given] < 0) {
        place[given] = static_cast<int>(surface.points.size());
        surface.points.push_back(points[given]);
      }
      corner = place[given];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const int edge = cells[c].rim[k];
      if (edge >= 0 && solid.edges()[at(edge)].faces[1] == cells[c].face)
        right_cell[{cells[c].corners[(k + 1) % 3], cells[c].corners[k]}] = static_cast<int>(c);
    }
  }
  surface.cells = std::move(cells);
  for (std::size_t c = 0; c < surface.cells.size(); ++c) {
    const SurfaceCell& cell = surface.cells[c];
    for (std::size_t k = 0; k < 3; ++k) {
      if (cell.rim[k] < 0) continue;
      const PolyhedronEdge& edge = solid.edges()[at(cell.rim[k])];
      if (edge.faces[0] != cell.face) continue;
      const Side side = {cell.corners[k], cell.corners[(k + 1) % 3]};
      surface.edges.push_back(
          {{side.first, side.second}, {static_cast<int>(c), right_cell.at(side)}, edge.convex});
    }
  }
  find_vertices(surface);
  surface.face_share = face_shares(solid);
  surface.convex_neighbours = convex_neighbours(solid);
  find_neighbours(solid, surface);
  return surface;
}

}  // namespace ashlar

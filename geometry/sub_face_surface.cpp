#include "geometry/sub_face_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace ashlar {
namespace {

using Side = std::pair<int, int>;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

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
    const int ab = midpoint(a, b);
    const int bc = midpoint(b, c);
    const int ca = midpoint(c, a);
    children.push_back({cell.face, {a, ab, ca}});
    children.push_back({cell.face, {ab, b, bc}});
    children.push_back({cell.face, {ca, bc, c}});
    children.push_back({cell.face, {ab, bc, ca}});
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

/// Cells of every directed side.
std::map<Side, int> sides_of(const std::vector<SurfaceCell>& cells) {
  std::map<Side, int> sides;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto& corners = cells[c].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      sides[{corners[k], corners[(k + 1) % corners.size()]}] = static_cast<int>(c);
    }
  }
  return sides;
}

/// Whether the edge between two faces is convex; two faces may share several edges, all of one kind in a
/// plane pair.
std::map<Side, bool> convexity_of_face_pairs(const Polyhedron& solid) {
  std::map<Side, bool> convex;
  for (const PolyhedronEdge& edge : solid.edges()) convex[sorted(edge.faces[0], edge.faces[1])] = edge.convex;
  return convex;
}

void find_edges(const Polyhedron& solid, SubFaceSurface& surface) {
  const auto sides = sides_of(surface.cells);
  const auto convex = convexity_of_face_pairs(solid);
  for (const auto& [side, cell] : sides) {
    const auto twin = sides.find({side.second, side.first});
    // A whole convex face and the triangles of its neighbour may differ in points inside straight sides; the
    // polyhedron's own edge then stands in below.
    if (twin == sides.end() || twin->second < cell) continue;
    const int left = surface.cells[at(cell)].face;
    const int right = surface.cells[at(twin->second)].face;
    if (left == right) continue;
    surface.edges.push_back(
        {{side.first, side.second}, {cell, twin->second}, convex.at(sorted(left, right))});
  }
}

/// Edges of the polyhedron between undivided faces, with any cell of each face that touches the edge.
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

void find_vertices(SubFaceSurface& surface) {
  std::map<int, SurfaceVertex> vertices;
  for (const SurfaceEdge& edge : surface.edges) {
    for (const int end : edge.ends) vertices[end].point = end;
    vertices[edge.ends[0]].neighbours.push_back(edge.ends[1]);
    vertices[edge.ends[1]].neighbours.push_back(edge.ends[0]);
  }
  for (std::size_t c = 0; c < surface.cells.size(); ++c) {
    const auto& corners = surface.cells[c].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto vertex = vertices.find(corners[k]);
      if (vertex == vertices.end()) continue;
      vertex->second.cells.push_back(static_cast<int>(c));
      vertex->second.neighbours.push_back(corners[(k + 1) % corners.size()]);
      vertex->second.neighbours.push_back(corners[(k + corners.size() - 1) % corners.size()]);
    }
  }
  for (auto& [point, vertex] : vertices) {
    std::sort(vertex.neighbours.begin(), vertex.neighbours.end());
    vertex.neighbours.erase(std::unique(vertex.neighbours.begin(), vertex.neighbours.end()),
                            vertex.neighbours.end());
    surface.vertices.push_back(std::move(vertex));
  }
}

}  // namespace

SubFaceSurface divide_surface(const Polyhedron& solid, int levels) {
  if (levels < 0 || levels > 8) throw std::invalid_argument("levels of subdivision must be 0 to 8");
  SubFaceSurface surface;
  surface.points = solid.mesh().points;
  surface.divided = levels > 0;
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    const PolyhedronFace& face = solid.faces()[f];
    if (levels == 0 && face.convex) {
      surface.cells.push_back({static_cast<int>(f), face.loops.front()});
      continue;
    }
    for (const int t : face.triangles) {
      const auto& [a, b, c] = solid.mesh().triangles[at(t)];
      surface.cells.push_back({static_cast<int>(f), {a, b, c}});
    }
  }
  for (int level = 0; level < levels; ++level) split(surface.points, surface.cells);
  if (levels == 0) {
    take_edges_of_polyhedron(solid, surface);
  } else {
    find_edges(solid, surface);
  }
  find_vertices(surface);
  surface.face_share = face_shares(solid);
  std::vector<std::set<int>> neighbours(solid.faces().size());
  for (const PolyhedronEdge& edge : solid.edges()) {
    neighbours[at(edge.faces[0])].insert(edge.faces[1]);
    neighbours[at(edge.faces[1])].insert(edge.faces[0]);
  }
  for (const auto& set : neighbours) surface.face_neighbours.emplace_back(set.begin(), set.end());
  return surface;
}

}  // namespace ashlar

#include "geometry/solid/polyhedron.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "geometry/exact/direction_predicates.hpp"
#include "geometry/exact/rounding_mode.hpp"
#include "geometry/lexicographic.hpp"
#include "geometry/solid/exact_surface.hpp"
#include "geometry/solid/flat_regions.hpp"
#include "geometry/solid/half_edges.hpp"
#include "geometry/union_find.hpp"

namespace ashlar {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Merges the triangles of a sound mesh. An edge of the mesh is sharp unless its two triangles are coplanar;
// the faces are the connected sets of triangles between sharp edges. The flat fans at a point with two sharp
// edges lie in two planes whose common line carries both edges: such a point is inside a straight side. One
// sharp edge alone cannot end at a point, so corners are the points with three or more.
//
// At a resolution, if relevant, flat_regions() determines the flat edges, bends are those between the faces' planes,
// and points off a straight side are corners too.
class FaceBuilder {
 public:
  FaceBuilder(const TriangleMesh& mesh, const std::vector<int>& twins, double resolution)
      : mesh_(mesh), twins_(twins), resolution_(resolution) {}

  void build() {
    bend_.assign(twins_.size(), CGAL::ZERO);
    {
      const NearestRounding nearest;
      find_bends();
    }
    if (resolution_ > 0.0) flatten_regions();
    collect_faces();
    if (rounded_) find_bends_of_faces();
    find_sharp_edges();
    collect_edges();
    for (PolyhedronFace& face : faces) finish_face(face);
  }

  std::vector<PolyhedronFace> faces;
  std::vector<PolyhedronEdge> edges;
  std::vector<int> face_of_triangle;
  std::vector<int> corners;
  bool convex = true;

 private:
  [[nodiscard]] int start(int h) const { return start_of(mesh_.triangles, h); }
  [[nodiscard]] bool is_sharp(int h) const { return bend_[h] != CGAL::ZERO; }
  [[nodiscard]] bool is_corner(int v) const { return is_corner_[v]; }

  void find_sharp_edges() {
    std::vector<int> sharp_degree(mesh_.points.size(), 0);
    std::vector<std::array<int, 2>> ends(mesh_.points.size());  // of the last sharp edges at each point
    const auto count = [&](int from, int to) {
      ++sharp_degree[from];
      ends[from] = {ends[from][1], to};
    };
    for (int h = 0; h < static_cast<int>(twins_.size()); ++h) {
      const int twin = twins_[h];
      if (twin < h || !is_sharp(h)) continue;
      convex = convex && bend_[h] == CGAL::NEGATIVE;
      count(start(h), start(twin));
      count(start(twin), start(h));
    }
    is_corner_.assign(mesh_.points.size(), false);
    for (int v = 0; v < static_cast<int>(mesh_.points.size()); ++v) {
      const bool bent =
          rounded_ && sharp_degree[v] == 2 && distance_from_line(v, ends[v][0], ends[v][1]) > resolution_;
      is_corner_[v] = sharp_degree[v] > 2 || bent;
      if (is_corner_[v]) corners.push_back(v);
    }
  }

  [[nodiscard]] double distance_from_line(int v, int from, int to) const {
    const std::vector<Vector3>& x = mesh_.points;
    return (x[v] - x[from]).cross((x[to] - x[from]).stableNormalized()).norm();
  }

  /// Edges within a region are flat, and edges that are flat to the last bit unite regions.
  void flatten_regions() {
    const std::vector<int> regions = flat_regions(mesh_, twins_, resolution_);
    UnionFind united(mesh_.triangles.size());
    const auto region = [&](int h) { return united.find(regions[h / 3]); };
    for (int h = 0; h < static_cast<int>(twins_.size()); ++h)
      if (!is_sharp(h)) united.unite(region(h), region(twins_[h]));
    for (int h = 0; h < static_cast<int>(twins_.size()); ++h) {
      if (!is_sharp(h) || region(h) != region(twins_[h])) continue;
      bend_[h] = bend_[twins_[h]] = CGAL::ZERO;
      rounded_ = true;
    }
  }

  /// Determines bends of sharp edges by the planes of their faces.
  void find_bends_of_faces() {
    for (int h = 0; h < static_cast<int>(twins_.size()); ++h) {
      if (twins_[h] < h || !is_sharp(h)) continue;
      const Vector3 along = mesh_.points[start(twins_[h])] - mesh_.points[start(h)];
      const Vector3& left = faces[face_of_triangle[h / 3]].normal;
      const Vector3& right = faces[face_of_triangle[twins_[h] / 3]].normal;
      const double turn = left.cross(right).dot(along);
      if (turn != 0.0) bend_[h] = bend_[twins_[h]] = turn > 0.0 ? CGAL::NEGATIVE : CGAL::POSITIVE;
    }
  }

  // Not inlined, so that no arithmetic is moved across the change of the rounding mode.
  [[gnu::noinline]] void find_bends() {
    NumericRange range;
    for (const Vector3& p : mesh_.points)
      for (int d = 0; d < 3; ++d) range.include(p[d]);
    PredicateLadder ladder;
    ladder.open(range);
    for (int h = 0; h < static_cast<int>(twins_.size()); ++h)
      if (twins_[h] >= h) bend_[h] = bend_[twins_[h]] = bend_over(h, twins_[h], ladder);
  }
  // Negative if the neighbour's third corner lies below the triangle, inside: a convex edge.
  [[nodiscard]] CGAL::Sign bend_over(int h, int twin, PredicateLadder& ladder) const {
    const auto& [a, b, c] = mesh_.triangles[h / 3];
    const int apex = start(previous_half_edge(twin));
    const std::vector<Vector3>& x = mesh_.points;
    return CGAL::sign(sign_volume(x[a], x[b], x[c], x[apex], ladder));
  }

  void collect_faces() {
    face_of_triangle.assign(mesh_.triangles.size(), -1);
    for (int seed = 0; seed < static_cast<int>(mesh_.triangles.size()); ++seed) {
      if (face_of_triangle[seed] >= 0) continue;
      const int number = static_cast<int>(faces.size());
      PolyhedronFace& face = faces.emplace_back();
      face.triangles = {seed};
      face_of_triangle[seed] = number;
      for (std::size_t i = 0; i < face.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
          const int h = 3 * face.triangles[i] + k;
          const int neighbour = twins_[h] / 3;
          if (is_sharp(h) || face_of_triangle[neighbour] >= 0) continue;
          face_of_triangle[neighbour] = number;
          face.triangles.push_back(neighbour);
        }
      }
      std::sort(face.triangles.begin(), face.triangles.end());
      face.normal = area_direction(mesh_, face.triangles);
    }
  }

  // The sharp half-edge that follows a sharp one on the boundary of its face, turning inside the face.
  [[nodiscard]] int next_on_boundary(int h) const {
    int next = next_half_edge(h);
    while (!is_sharp(next)) next = next_half_edge(twins_[next]);
    return next;
  }

  void collect_edges() {
    for (int h = 0; h < static_cast<int>(twins_.size()); ++h) {
      if (!is_sharp(h) || !is_corner(start(h))) continue;
      int last = h;
      while (!is_corner(start(twins_[last]))) last = next_on_boundary(last);
      // The other side starts from the far corner with the twin of the last piece.
      if (twins_[last] < h) continue;
      edges.push_back({{start(h), start(twins_[last])},
                       {face_of_triangle[h / 3], face_of_triangle[twins_[h] / 3]},
                       bend_[h] == CGAL::NEGATIVE});
    }
  }

  void finish_face(PolyhedronFace& face) {
    for (const int t : face.triangles) {
      for (int h = 3 * t; h < 3 * t + 3; ++h) {
        if (is_sharp(h) && is_corner(start(h)) && !visited(h)) trace_loop(h, face.loops);
      }
    }
    if (face.loops.size() > 1) move_outer_loop_to_front(face.loops);
    face.convex = face.loops.size() == 1 && is_convex(face.loops[0], face.normal);
  }

  [[nodiscard]] bool visited(int h) {
    visited_.resize(twins_.size(), 0);
    return visited_[h] != 0;
  }

  // Collects the corners of one boundary; a corner met again closes a loop of its own.
  void trace_loop(int first, std::vector<std::vector<int>>& loops) {
    std::vector<int> open;
    int h = first;
    do {
      visited_[h] = 1;
      if (is_corner(start(h))) {
        const auto again = std::find(open.begin(), open.end(), start(h));
        if (again != open.end()) {
          loops.emplace_back(again, open.end());
          open.erase(again, open.end());
        }
        open.push_back(start(h));
      }
      h = next_on_boundary(h);
    } while (h != first);
    loops.push_back(std::move(open));
  }

  // The outer loop reaches both extreme points of the face. A hole may touch it in one of them, not in both, which
  // would divide the face.
  void move_outer_loop_to_front(std::vector<std::vector<int>>& loops) const {
    const auto less = [this](int u, int v) {
      return lexicographically_less(mesh_.points[u], mesh_.points[v]);
    };
    std::pair<int, int> extremes(loops[0][0], loops[0][0]);
    for (const auto& loop : loops) {
      for (const int v : loop) {
        if (less(v, extremes.first)) extremes.first = v;
        if (less(extremes.second, v)) extremes.second = v;
      }
    }
    const auto outer = std::find_if(loops.begin(), loops.end(), [&extremes](const std::vector<int>& loop) {
      return std::find(loop.begin(), loop.end(), extremes.first) != loop.end() &&
             std::find(loop.begin(), loop.end(), extremes.second) != loop.end();
    });
    std::rotate(loops.begin(), outer, outer + 1);
  }

  // The turn at a corner is the orientation of its projection along the axis nearest to the normal.
  [[nodiscard]] bool is_convex(const std::vector<int>& loop, const Vector3& normal) const {
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto point = [&](std::size_t i) {
      const Vector3& p = mesh_.points[loop[i % loop.size()]];
      return Kernel::Point_2(p[u], p[v]);
    };
    const CGAL::Orientation reflex = normal[axis] > 0.0 ? CGAL::CLOCKWISE : CGAL::COUNTERCLOCKWISE;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (CGAL::orientation(point(i), point(i + 1), point(i + 2)) != reflex) continue;
      const auto corner = [&](std::size_t k) { return loop[k % loop.size()]; };
      if (rounded_ && distance_from_line(corner(i + 1), corner(i), corner(i + 2)) <= resolution_) continue;
      return false;
    }
    return true;
  }

  const TriangleMesh& mesh_;
  const std::vector<int>& twins_;
  double resolution_;             // m
  bool rounded_ = false;          // true: the resolution is relevant
  std::vector<CGAL::Sign> bend_;  // by half-edge
  std::vector<bool> is_corner_;   // by point
  std::vector<char> visited_;     // by half-edge
};

}  // namespace

std::vector<MeshDefect> Polyhedron::find_defects(const TriangleMesh& mesh, std::size_t limit) {
  return check_mesh(mesh, limit).defects;
}

Polyhedron::Polyhedron(TriangleMesh mesh, double resolution) : mesh_(std::move(mesh)) {
  constexpr std::size_t listed_defects = 10;
  MeshCheck check = check_mesh(mesh_, listed_defects);
  if (!check.defects.empty()) throw MeshError(std::move(check.defects));
  volume_ = check.volume;
  FaceBuilder builder(mesh_, check.twins, resolution);
  builder.build();
  faces_ = std::move(builder.faces);
  edges_ = std::move(builder.edges);
  face_of_triangle_ = std::move(builder.face_of_triangle);
  corners_ = std::move(builder.corners);
  convex_ = builder.convex;
}

Polyhedron Polyhedron::with_points(std::vector<Vector3> points) const {
  if (points.size() != mesh_.points.size()) {
    throw std::invalid_argument("number of points (" + std::to_string(points.size()) + "), must be " +
                                std::to_string(mesh_.points.size()));
  }
  const bool finite =
      std::all_of(points.begin(), points.end(), [](const Vector3& p) { return p.allFinite(); });
  if (!finite) throw std::invalid_argument("moved points must be finite");
  Polyhedron moved = *this;
  moved.mesh_.points = std::move(points);
  moved.volume_ = signed_volume(moved.mesh_);
  if (!(moved.volume_ > 0.0) || !std::isfinite(moved.volume_)) {
    throw std::invalid_argument("volume of the moved solid (" + std::to_string(moved.volume_) +
                                "), must be positive and finite");
  }
  for (PolyhedronFace& face : moved.faces_) face.normal = area_direction(moved.mesh_, face.triangles);
  return moved;
}

Polyhedron Polyhedron::with_triangles(TriangleMesh mesh, std::vector<int> face_of_triangle) const {
  if (face_of_triangle.size() != mesh.triangles.size())
    throw std::invalid_argument("every triangle needs the face it is a part of");
  std::map<std::array<double, 3>, int> place;
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    const Vector3& point = mesh.points[k];
    place.emplace(std::array{point.x(), point.y(), point.z()}, static_cast<int>(k));
  }
  const auto moved_index = [&](int corner) {
    const Vector3& point = mesh_.points[corner];
    const auto found = place.find({point.x(), point.y(), point.z()});
    if (found == place.end()) throw std::invalid_argument("a corner of the solid is not a point of the mesh");
    return found->second;
  };
  Polyhedron result = *this;
  for (PolyhedronFace& face : result.faces_) {
    face.triangles.clear();
    for (auto& loop : face.loops) std::transform(loop.begin(), loop.end(), loop.begin(), moved_index);
  }
  for (std::size_t t = 0; t < face_of_triangle.size(); ++t)
    result.faces_.at(face_of_triangle[t]).triangles.push_back(static_cast<int>(t));
  for (PolyhedronEdge& edge : result.edges_) {
    for (int& vertex : edge.vertices) vertex = moved_index(vertex);
  }
  for (int& corner : result.corners_) corner = moved_index(corner);
  std::sort(result.corners_.begin(), result.corners_.end());
  result.mesh_ = std::move(mesh);
  result.face_of_triangle_ = std::move(face_of_triangle);
  return result;
}

}  // namespace ashlar

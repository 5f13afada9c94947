#include "geometry/solid/hull_solid.hpp"

#include <algorithm>
#include <utility>

#include "geometry/mesh/polygon_triangulation.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar {
namespace {

/// Omits triangles of faces without an outline, which very small ones may lack.
TriangleMesh fans_of_faces(const Polyhedron& solid) {
  TriangleMesh fans;
  std::vector<int> place(solid.mesh().points.size(), -1);
  for (const int corner : solid.corners()) {
    place[corner] = static_cast<int>(fans.points.size());
    fans.points.push_back(solid.mesh().points[corner]);
  }
  for (const PolyhedronFace& face : solid.faces()) {
    if (face.loops.empty()) continue;
    std::vector<int> loop = face.loops.front();
    for (int& corner : loop) corner = place[corner];
    append_fan(std::move(loop), fans.triangles);
  }
  std::sort(fans.triangles.begin(), fans.triangles.end());
  return fans;
}

}  // namespace

Polyhedron make_hull_solid(std::span<const Vector3> points, double resolution) {
  TriangleMesh hull = make_convex_hull(points);
  Polyhedron solid(hull, resolution);
  TriangleMesh fans = fans_of_faces(solid);
  if (fans.triangles == hull.triangles && fans.points.size() == hull.points.size()) return solid;
  // For a body hardly thicker than the resolution other triangles may not bound a solid.
  if (!Polyhedron::find_defects(fans, 1).empty()) return solid;
  return Polyhedron(std::move(fans), resolution);
}

}  // namespace ashlar

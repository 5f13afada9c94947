#include "geometry/solid/face_axes.hpp"

#include <Eigen/Geometry>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

double area_of_triangle(const TriangleMesh& mesh, const std::array<int, 3>& corners) {
  const Vector3& start = mesh.points[at(corners[0])];
  return 0.5 * (mesh.points[at(corners[1])] - start).cross(mesh.points[at(corners[2])] - start).norm();
}

double area_of(const TriangleMesh& mesh, const PolyhedronFace& face) {
  double area = 0.0;
  for (const int triangle : face.triangles) area += area_of_triangle(mesh, mesh.triangles[at(triangle)]);
  return area;
}

}  // namespace

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& triangle : mesh.triangles) area += area_of_triangle(mesh, triangle);
  return area;
}

double largest_face_area(const Polyhedron& solid, double resolution) {
  double most = 0.0;
  for (const PolyhedronFace& face : solid.faces()) {
    const double area = area_of(solid.mesh(), face);
    if (area > (1.0 + resolution) * most) most = area;
  }
  return most;
}

Eigen::Matrix3d axes_along_largest_face(const std::vector<const Polyhedron*>& solids, double resolution) {
  const double larger = 1.0 + resolution;
  double most_area = 0.0;
  Vector3 normal = Vector3::UnitZ();
  Vector3 side = Vector3::UnitX();
  for (const Polyhedron* solid : solids) {
    const TriangleMesh& mesh = solid->mesh();
    for (const PolyhedronFace& face : solid->faces()) {
      const double area = area_of(mesh, face);
      if (area <= larger * most_area) continue;
      most_area = area;
      normal = face.normal;
      double longest = 0.0;
      const auto& loop = face.loops.front();
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vector3 along = mesh.points[at(loop[(k + 1) % loop.size()])] - mesh.points[at(loop[k])];
        if (along.norm() <= larger * longest) continue;
        longest = along.norm();
        side = along;
      }
    }
  }
  Eigen::Matrix3d axes;
  axes.col(2) = normal;
  axes.col(1) = normal.cross(side).normalized();
  axes.col(0) = axes.col(1).cross(normal);
  return axes;
}

}  // namespace ashlar

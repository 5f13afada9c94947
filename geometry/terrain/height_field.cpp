#include "geometry/terrain/height_field.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <stdexcept>

namespace ashlar {

HeightField height_field(const std::vector<Vector3>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
  using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
  Triangulation triangulation;
  HeightField field;
  for (const Vector3& point : points) {
    const auto before = triangulation.number_of_vertices();
    const auto vertex = triangulation.insert({point.x(), point.y()});
    if (triangulation.number_of_vertices() == before) {
      if (field.points[static_cast<std::size_t>(vertex->info())].z() != point.z())
        throw std::invalid_argument("two points of a surface have one place in plan and different heights");
      continue;
    }
    vertex->info() = static_cast<int>(field.points.size());
    field.points.push_back(point);
  }
  if (triangulation.dimension() < 2)
    throw std::invalid_argument("the points of a surface lie on one line in plan, or are fewer than three");
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    std::array<int, 3> corners = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    field.triangles.push_back(corners);
  }
  std::sort(field.triangles.begin(), field.triangles.end());
  return field;
}

}  // namespace ashlar

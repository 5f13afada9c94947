#include "geometry/cutting/loop_triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

constexpr int not_met = -1;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Face = CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                                       CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                               CGAL::No_constraint_intersection_tag>;

/// Determines for each triangle if the number of constraints between it and the outside is odd or even.
void find_inside(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = not_met;
  std::vector<Triangulation::Face_handle> open = {triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Triangulation::Face_handle next = face->neighbor(k);
      if (next->info() != not_met) continue;
      next->info() = (face->info() + (triangulation.is_constrained({face, k}) ? 1 : 0)) % 2;
      open.push_back(next);
    }
  }
}

}  // namespace

std::vector<std::array<int, 3>> triangulate_loops(const std::vector<Vector3>& corners,
                                                  const std::vector<std::vector<int>>& loops,
                                                  const Vector3& normal) {
  if (loops.size() == 1 && loops.front().size() == 3) return {{loops[0][0], loops[0][1], loops[0][2]}};
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  Triangulation triangulation;
  std::vector<std::array<int, 3>> triangles;
  try {
    for (const std::vector<int>& loop : loops) {
      std::vector<Triangulation::Vertex_handle> vertices;
      for (const int corner : loop) {
        const Vector3& x = corners[at(corner)];
        vertices.push_back(triangulation.insert({x[u], x[v]}));
        vertices.back()->info() = corner;
      }
      for (std::size_t k = 0; k < vertices.size(); ++k)
        triangulation.insert_constraint(vertices[k], vertices[(k + 1) % vertices.size()]);
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return {};
  }
  find_inside(triangulation);
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() == 1)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

}  // namespace ashlar

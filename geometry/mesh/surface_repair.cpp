#include "geometry/mesh/surface_repair.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <vector>

namespace ashlar {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalSurface = CGAL::Surface_mesh<Kernel::Point_3>;

// Most edges of a hole: covering a complex one needs cubic time.
constexpr std::size_t most_hole_edges = 1000;

struct Soup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> triangles;
};

Soup soup_of(const TriangleMesh& mesh) {
  Soup soup;
  for (const Vector3& point : mesh.points) soup.points.emplace_back(point.x(), point.y(), point.z());
  for (const auto& [a, b, c] : mesh.triangles)
    soup.triangles.push_back(
        {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  return soup;
}

TriangleMesh mesh_of(const CgalSurface& surface) {
  TriangleMesh mesh;
  std::vector<int> place(surface.num_vertices() + surface.number_of_removed_vertices(), -1);
  for (const CgalSurface::Vertex_index vertex : surface.vertices()) {
    place[vertex.idx()] = static_cast<int>(mesh.points.size());
    const Kernel::Point_3& point = surface.point(vertex);
    mesh.points.emplace_back(point.x(), point.y(), point.z());
  }
  for (const CgalSurface::Face_index face : surface.faces()) {
    std::array<int, 3> corners{};
    std::size_t k = 0;
    for (const CgalSurface::Vertex_index vertex : surface.vertices_around_face(surface.halfedge(face)))
      corners[k++] = place[vertex.idx()];
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace

SurfaceRepair repair_surface(TriangleMesh& mesh) {
  SurfaceRepair repair;
  Soup soup = soup_of(mesh);
  PMP::repair_polygon_soup(soup.points, soup.triangles);
  repair.removed = mesh.triangles.size() - soup.triangles.size();
  PMP::orient_polygon_soup(soup.points, soup.triangles);
  CgalSurface surface;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
  std::vector<CgalSurface::Halfedge_index> holes;
  PMP::extract_boundary_cycles(surface, std::back_inserter(holes));
  for (const CgalSurface::Halfedge_index hole : holes) {
    std::vector<CgalSurface::Face_index> added;
    if (CGAL::halfedges_around_face(hole, surface).size() > most_hole_edges) {
      repair.complete = false;
      continue;
    }
    PMP::triangulate_hole(surface, hole, std::back_inserter(added));
    if (added.empty()) repair.complete = false;
    repair.holes += added.empty() ? 0 : 1;
    repair.added += added.size();
  }
  if (CGAL::is_closed(surface) && !surface.is_empty() && !PMP::is_outward_oriented(surface)) {
    PMP::reverse_face_orientations(surface);
    repair.turned = true;
  }
  mesh = mesh_of(surface);
  return repair;
}

}  // namespace ashlar

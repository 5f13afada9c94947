#include "geometry/mesh/volume_mesh.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/index.hpp"
#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

// Outward facets of a tetrahedron of positive volume.
constexpr std::array<std::array<std::size_t, 3>, 4> facets = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

std::array<int, 3> facet_of(const std::array<int, 4>& tetrahedron, const std::array<std::size_t, 3>& facet) {
  return {tetrahedron[facet[0]], tetrahedron[facet[1]], tetrahedron[facet[2]]};
}

std::array<int, 3> sorted(std::array<int, 3> facet) {
  std::sort(facet.begin(), facet.end());
  return facet;
}

/// Triangles with their points, in the order of the mesh.
TriangleMesh with_own_points(const std::vector<Vector3>& points, std::vector<std::array<int, 3>> triangles) {
  std::vector<int> used;
  for (const auto& triangle : triangles) used.insert(used.end(), triangle.begin(), triangle.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  TriangleMesh mesh;
  for (const int point : used) mesh.points.push_back(points[at(point)]);
  for (auto& triangle : triangles)
    for (int& corner : triangle)
      corner = static_cast<int>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  mesh.triangles = std::move(triangles);
  return mesh;
}

std::vector<MeshGroup> triangles_of_groups(const VolumeMesh& mesh) {
  std::vector<std::vector<std::array<int, 3>>> members(mesh.groups.size());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    members[at(mesh.group_of[k])].push_back(mesh.triangles[k]);
  std::vector<MeshGroup> bodies;
  for (std::size_t g = 0; g < members.size(); ++g)
    bodies.push_back({mesh.groups[g], with_own_points(mesh.points, std::move(members[g]))});
  return bodies;
}

}  // namespace

VolumeMesh read_volume_mesh(const std::filesystem::path& path) {
  if (!is_volume_mesh(path))
    throw MeshFileError(
        "tetrahedra of a " + printable(path.extension().string()) + " file, only .msh files have them", 0, 0);
  return read_msh(read_mesh_bytes(path));
}

VolumeMesh only_group(const VolumeMesh& mesh, const std::string& group) {
  const auto found = std::find(mesh.groups.begin(), mesh.groups.end(), group);
  if (found == mesh.groups.end()) {
    std::string names;
    for (const std::string& name : mesh.groups) names += (names.empty() ? "" : ", ") + printable(name);
    throw MeshFileError("no physical group of the volume (" + printable(group) + "), there are " + names, 0,
                        0);
  }
  const int index = static_cast<int>(found - mesh.groups.begin());
  VolumeMesh only;
  only.points = mesh.points;
  only.groups = {group};
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k)
    if (mesh.group_of[k] == index) only.tetrahedra.push_back(mesh.tetrahedra[k]);
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    if (mesh.group_of[k] == index) only.triangles.push_back(mesh.triangles[k]);
  only.group_of.assign(only.tetrahedra.size() + only.triangles.size(), 0);
  return only;
}

TriangleMesh surface_of(const VolumeMesh& mesh, const std::vector<int>& chosen) {
  std::map<std::array<int, 3>, int> count;
  for (const int k : chosen)
    for (const auto& facet : facets) ++count[sorted(facet_of(mesh.tetrahedra[at(k)], facet))];
  std::vector<std::array<int, 3>> triangles;
  for (const int k : chosen) {
    for (const auto& facet : facets) {
      const std::array<int, 3> corners = facet_of(mesh.tetrahedra[at(k)], facet);
      const int times = count.at(sorted(corners));
      if (times > 2)
        throw MeshFileError("facet of " + std::to_string(times) + " tetrahedra, at most 2 can share one", 0,
                            0);
      if (times == 1) triangles.push_back(corners);
    }
  }
  return with_own_points(mesh.points, std::move(triangles));
}

TriangleMesh surface_of(const VolumeMesh& mesh) {
  if (mesh.tetrahedra.empty()) return with_own_points(mesh.points, mesh.triangles);
  std::vector<int> all(mesh.tetrahedra.size());
  std::iota(all.begin(), all.end(), 0);
  return surface_of(mesh, all);
}

std::vector<MeshGroup> surfaces_of_groups(const VolumeMesh& mesh) {
  if (mesh.tetrahedra.empty()) return triangles_of_groups(mesh);
  std::vector<std::vector<int>> members(mesh.groups.size());
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k)
    members[at(mesh.group_of[k])].push_back(static_cast<int>(k));
  std::vector<MeshGroup> bodies;
  for (std::size_t g = 0; g < members.size(); ++g)
    bodies.push_back({mesh.groups[g], surface_of(mesh, members[g])});
  return bodies;
}

std::vector<MeshGroup> surfaces_of_tetrahedra(const VolumeMesh& mesh) {
  if (mesh.tetrahedra.empty())
    throw MeshFileError(
        "file has no tetrahedra, split = \"groups\" makes bodies of the triangles of its groups", 0, 0);
  std::vector<MeshGroup> bodies;
  for (int k = 0; k < static_cast<int>(mesh.tetrahedra.size()); ++k)
    bodies.push_back({std::to_string(k + 1), surface_of(mesh, {k})});
  return bodies;
}

}  // namespace ashlar

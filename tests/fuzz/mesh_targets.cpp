#include <algorithm>
#include <cmath>

#include "fuzz/refusal.hpp"
#include "fuzz/targets.hpp"
#include "geometry/exact/coordinate_limit.hpp"
#include "geometry/mesh/mesh_formats.hpp"

namespace ashlar::fuzz {
namespace {

bool mesh(PolygonSoup (*read)(std::string_view), std::string_view bytes) {
  try {
    const TriangleMesh mesh = triangulated(read(bytes));
    require(!mesh.triangles.empty(), "a mesh has triangles");
    const int count = static_cast<int>(mesh.points.size());
    for (const auto& triangle : mesh.triangles)
      for (const int corner : triangle) require(corner >= 0 && corner < count, "indices are in range");
    for (const Vector3& point : mesh.points)
      for (const double coordinate : point) require(!is_too_far(coordinate), "coordinates are in range");
    return true;
  } catch (const MeshFileError& error) {
    return refused(error);
  }
}

}  // namespace

bool off(std::string_view bytes) {
  return mesh(read_off, bytes);
}
bool obj(std::string_view bytes) {
  return mesh(read_obj, bytes);
}
bool stl(std::string_view bytes) {
  return mesh(read_stl, bytes);
}
bool ply(std::string_view bytes) {
  return mesh(read_ply, bytes);
}

bool groups(std::string_view bytes) {
  try {
    const PolygonSoup soup = read_obj(bytes);
    const std::vector<MeshGroup> groups = triangulated_groups(soup);
    std::size_t triangles = 0;
    for (const MeshGroup& group : groups) {
      triangles += group.mesh.triangles.size();
      require(!group.mesh.triangles.empty(), "a group has triangles");
      std::vector<bool> used(group.mesh.points.size(), false);
      for (const auto& triangle : group.mesh.triangles)
        for (const int corner : triangle) used.at(static_cast<std::size_t>(corner)) = true;
      // A polygon that is not simple may leave corners out.
      require(group.mesh.points.size() >= 3 || std::find(used.begin(), used.end(), true) != used.end(),
              "a group has points");
    }
    require(triangles == triangulated(soup).triangles.size(), "every triangle is in one group");
    return true;
  } catch (const MeshFileError&) {
    return false;
  }
}

}  // namespace ashlar::fuzz

#include <algorithm>
#include <cmath>

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
    require(error.line() >= 0 && error.column() >= 0, "places are not negative");
    require(error.what()[0] != '\0', "a refusal has a reason");
    return false;
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

}  // namespace ashlar::fuzz

#include <algorithm>
#include <array>
#include <sstream>

#include "apps/scene/meshes/dxf_reader.hpp"
#include "apps/scene/meshes/gltf_reader.hpp"
#include "apps/scene/meshes/height_grid.hpp"
#include "apps/scene/meshes/threemf_reader.hpp"
#include "fuzz/targets.hpp"
#include "geometry/exact/coordinate_limit.hpp"

namespace ashlar::fuzz {
namespace {

void check(const TriangleMesh& mesh) {
  require(!mesh.triangles.empty(), "a mesh has triangles");
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) {
      require(corner >= 0 && corner < static_cast<int>(mesh.points.size()), "indices are in range");
      used[static_cast<std::size_t>(corner)] = true;
    }
  std::vector<std::array<double, 3>> points;
  for (const Vector3& point : mesh.points) {
    require(point.allFinite() && !is_too_far(point.cwiseAbs().maxCoeff()), "coordinates are in range");
    points.push_back({point.x(), point.y(), point.z()});
  }
  std::sort(points.begin(), points.end());
  require(std::adjacent_find(points.begin(), points.end()) == points.end(), "equal points are one");
}

/// @param bytes that the layout's limits go by
template <class Read>
bool import(Read read, std::size_t bytes) {
  try {
    const ShapeLayout layout = read();
    const TriangleMesh whole = layout.whole();
    check(whole);
    std::size_t triangles = 0;
    for (const MeshGroup& group : layout.groups()) {
      check(group.mesh);
      require(!group.name.empty(), "a group has a name");
      triangles += group.mesh.triangles.size();
    }
    require(triangles == whole.triangles.size(), "every triangle is in one group");
    // Faces have four corners at most, hence two triangles.
    require(triangles <= 2 * layout_limits(bytes).faces, "faces are bounded");
    return true;
  } catch (const MeshFileError& error) {
    require(error.line() >= 0 && error.column() >= 0, "places are not negative");
    require(error.what()[0] != '\0', "a refusal has a reason");
    return false;
  }
}

std::shared_ptr<const std::string> no_file(const std::string&) {
  throw MeshFileError("no files beside it", 0, 0);
}

}  // namespace

bool grid(std::string_view bytes) {
  int read = 0;
  for (TriangleMesh (*parse)(std::istream&) : {parse_esri_grid, parse_xyz_grid}) {
    std::istringstream content{std::string(bytes)};
    try {
      check(parse(content));
      ++read;
    } catch (const MeshFileError& error) {
      require(error.line() >= 0 && error.column() >= 0, "places are not negative");
      require(error.what()[0] != '\0', "a refusal has a reason");
    }
  }
  return read > 0;
}

bool gltf(std::string_view bytes) {
  return import([&] { return read_gltf(bytes, no_file); }, 2 * bytes.size());
}
bool glb(std::string_view bytes) {
  return import([&] { return read_glb(bytes, no_file); }, 2 * bytes.size());
}
bool dxf(std::string_view bytes) {
  return import([&] { return read_dxf(bytes); }, bytes.size());
}
bool package(std::string_view bytes) {
  return import([&] { return read_3mf(bytes); }, most_inflated(bytes.size()));
}
bool model(std::string_view bytes) {
  return import([&] { return read_3mf_model(bytes); }, bytes.size());
}

}  // namespace ashlar::fuzz

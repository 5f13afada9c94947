#include "geometry/mesh/mesh_io.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/polygon_triangulation.hpp"
#include "geometry/mesh/text_scanner.hpp"
#include "geometry/mesh/volume_mesh.hpp"
#include "geometry/text/reading_folder.hpp"

namespace ashlar {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string_view ending;
  PolygonSoup (*read)(std::string_view);
};

constexpr std::array<Format, 4> formats = {
    {{".off", read_off}, {".obj", read_obj}, {".stl", read_stl}, {".ply", read_ply}}};

const Format& format_of(const fs::path& path) {
  const std::string ending = path.extension().string();
  for (const Format& format : formats) {
    if (equal_ignoring_case(ending, format.ending)) return format;
  }
  throw MeshFileError(
      "ending of the mesh file (" + printable(ending) + "), allowed .off, .obj, .stl, .ply, .msh", 0, 0);
}

}  // namespace

std::string read_mesh_bytes(const fs::path& path, const std::string& what) {
  if (const std::string refusal = refusal_to_read(path); !refusal.empty())
    throw MeshFileError(what + " is " + refusal, 0, 0);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw MeshFileError(what + " does not exist", 0, 0);
  if (!fs::is_regular_file(status)) throw MeshFileError(what + " is not a regular file", 0, 0);
  std::ifstream file;
  file.rdbuf()->pubsetbuf(nullptr, 0);  // one read of the whole file needs no buffer
  file.open(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (size < 0) throw MeshFileError(what + " cannot be read", 0, 0);
  if (size > std::numeric_limits<int>::max()) {
    throw MeshFileError(what + " of " + std::to_string(size) + " bytes, allowed up to 2 GiB", 0, 0);
  }
  if (size == 0) throw MeshFileError(what + " is empty", 0, 0);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.seekg(0);
  if (!file.read(bytes.data(), size)) throw MeshFileError(what + " cannot be read", 0, 0);
  return bytes;
}

TriangleMesh triangulated(PolygonSoup soup) {
  // About a second of work: enough for a face of 10,000 corners whose ears are found at the first attempt.
  constexpr std::size_t most_tests = 50'000'000;
  std::size_t tests_left = most_tests;
  TriangleMesh mesh;
  mesh.points = std::move(soup.points);
  mesh.triangles.reserve(soup.face_count());
  for (std::size_t f = 0; f < soup.face_count(); ++f) {
    try {
      triangulate_polygon(mesh.points, soup.face(f), mesh.triangles, tests_left);
    } catch (const std::length_error&) {
      throw MeshFileError("corners of face " + std::to_string(f) + " (" +
                              std::to_string(soup.face(f).size()) +
                              "), too many to divide it, triangles are needed",
                          0, 0);
    }
  }
  return mesh;
}

namespace {

// The faces of one group with their points, in the order of the file.
std::vector<PolygonSoup> divided(const PolygonSoup& soup) {
  std::vector<PolygonSoup> parts(soup.groups.size());
  std::vector<std::vector<std::size_t>> faces(soup.groups.size());
  for (std::size_t f = 0; f < soup.face_count(); ++f)
    faces[static_cast<std::size_t>(soup.group_of_face[f])].push_back(f);
  std::vector<int> place(soup.points.size(), -1);
  for (std::size_t g = 0; g < parts.size(); ++g) {
    PolygonSoup& part = parts[g];
    for (const std::size_t f : faces[g])
      for (const int corner : soup.face(f)) part.corners.push_back(corner);
    std::vector<int> used = part.corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const int point : used) {
      place[static_cast<std::size_t>(point)] = static_cast<int>(part.points.size());
      part.points.push_back(soup.points[static_cast<std::size_t>(point)]);
    }
    for (int& corner : part.corners) corner = place[static_cast<std::size_t>(corner)];
    int end = 0;
    for (const std::size_t f : faces[g])
      part.face_ends.push_back(end += static_cast<int>(soup.face(f).size()));
  }
  return parts;
}

}  // namespace

bool is_volume_mesh(const fs::path& path) {
  return equal_ignoring_case(path.extension().string(), ".msh");
}

std::vector<MeshGroup> triangulated_groups(const PolygonSoup& soup) {
  std::vector<MeshGroup> groups;
  for (PolygonSoup& part : divided(soup))
    groups.push_back({soup.groups[groups.size()], triangulated(std::move(part))});
  return groups;
}

std::vector<MeshGroup> read_mesh_groups(const fs::path& path) {
  if (is_volume_mesh(path)) return surfaces_of_groups(read_volume_mesh(path));
  const Format& format = format_of(path);
  if (format.read != read_obj)
    throw MeshFileError(
        "groups of a " + std::string(format.ending) + " file, only .obj and .msh files have groups", 0, 0);
  const std::string bytes = read_mesh_bytes(path);
  return triangulated_groups(read_obj(bytes));
}

TriangleMesh read_mesh(const fs::path& path) {
  if (is_volume_mesh(path)) return surface_of(read_volume_mesh(path));
  const Format& format = format_of(path);
  const std::string bytes = read_mesh_bytes(path);
  return triangulated(format.read(bytes));
}

}  // namespace ashlar

#include "geometry/mesh/mesh_io.hpp"

#include <array>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "geometry/mesh/mesh_formats.hpp"
#include "geometry/mesh/polygon_triangulation.hpp"
#include "geometry/mesh/text_scanner.hpp"

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
  throw MeshFileError("ending of the mesh file (" + printable(ending) + "), allowed .off, .obj, .stl, .ply",
                      0, 0);
}

std::string read_bytes(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw MeshFileError("mesh file does not exist", 0, 0);
  if (!fs::is_regular_file(status)) throw MeshFileError("mesh file is not a regular file", 0, 0);
  std::ifstream file;
  file.rdbuf()->pubsetbuf(nullptr, 0);  // one read of the whole file needs no buffer
  file.open(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (size < 0) throw MeshFileError("mesh file cannot be read", 0, 0);
  if (size > std::numeric_limits<int>::max()) {
    throw MeshFileError("mesh file of " + std::to_string(size) + " bytes, allowed up to 2 GiB", 0, 0);
  }
  if (size == 0) throw MeshFileError("mesh file is empty", 0, 0);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.seekg(0);
  if (!file.read(bytes.data(), size)) throw MeshFileError("mesh file cannot be read", 0, 0);
  return bytes;
}

}  // namespace

TriangleMesh triangulated(PolygonSoup soup) {
  // About a second of work: enough for a face of 10,000 corners whose ears are found at the first try.
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

TriangleMesh read_mesh(const fs::path& path) {
  const Format& format = format_of(path);
  const std::string bytes = read_bytes(path);
  return triangulated(format.read(bytes));
}

}  // namespace ashlar

// Readers of the four mesh formats, from the whole file in memory to points and polygons. They are stricter than
// those of CGAL, which give no place of an error, allocate the sizes claimed by a header, end a face silently at a
// malformed index, accept indices one past the end, and accept truncated files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Points and polygons as a file lists them.
struct PolygonSoup {
  std::vector<Vector3> points;
  std::vector<int> corners;         ///< point indices of all polygons, one after the other
  std::vector<int> face_ends;       ///< face f has corners face_ends[f - 1] (or 0) up to face_ends[f] - 1
  std::vector<std::string> groups;  ///< names in the order of their first faces; OBJ only
  std::vector<int> group_of_face;   ///< (#faces), indices into groups; OBJ only

  [[nodiscard]] std::size_t face_count() const { return face_ends.size(); }
  [[nodiscard]] std::span<const int> face(std::size_t f) const {
    const int begin = f == 0 ? 0 : face_ends[f - 1];
    return std::span(corners).subspan(begin, face_ends[f] - begin);
  }
};

/// All readers promise: indices in range, at least three corners to a face. They allocate no more than a
/// multiple of the bytes given, whatever a header claims. Coordinates may be NaN or infinite, but finite ones
/// are no farther from zero than largest_coordinate.
/// @param text at most 2^31 - 1 bytes. @throws MeshFileError.
/// @{

/// OFF, with normal, colour and texture columns (NOFF, COFF, STOFF; colours at faces with every header); not
/// the binary, 4-dimensional and n-dimensional kinds.
[[nodiscard]] PolygonSoup read_off(std::string_view text);

/// OBJ: v and f statements, f with negative indices and with v/vt/vn; o and g statements name the faces that
/// follow; other known statements are passed over.
[[nodiscard]] PolygonSoup read_obj(std::string_view text);

/// STL, text or binary: binary if the size is that of the number of triangles it states. Points with the same
/// bits are one.
[[nodiscard]] PolygonSoup read_stl(std::string_view text);

/// PLY, text or binary of either byte order: elements vertex (x, y, z) and face (vertex_indices or
/// vertex_index), other elements and properties are passed over. A text file's numbers are read as doubles,
/// also where the header says float.
[[nodiscard]] PolygonSoup read_ply(std::string_view text);

/// @}

/// All bytes of a mesh file. @param what name of the file for messages: other models are read likewise
/// @throws MeshFileError
[[nodiscard]] std::string read_mesh_bytes(const std::filesystem::path& path,
                                          const std::string& what = "mesh file");

/// The faces divided by triangulate_polygon. @throws MeshFileError if their corners are too many for that
[[nodiscard]] TriangleMesh triangulated(PolygonSoup soup);

/// The same of each group, with the points that it uses. @param soup of read_obj. @throws MeshFileError as triangulated
[[nodiscard]] std::vector<MeshGroup> triangulated_groups(const PolygonSoup& soup);

}  // namespace ashlar

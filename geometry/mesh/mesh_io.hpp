// Reading surface meshes (OFF, OBJ, STL, PLY; text and binary where the format has both), and the surfaces of
// volume meshes (MSH). See mesh_formats.hpp and volume_mesh.hpp for what is accepted of each.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// A file that cannot be read as a mesh; what() is "reason (value), allowed", without the file's name.
class MeshFileError : public std::runtime_error {
 public:
  MeshFileError(const std::string& what, int line, int column)
      : runtime_error(what), line_(line), column_(column) {}
  /// 1-based place in the file, 0 where it is not known.
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] int column() const { return column_; }

 private:
  int line_;
  int column_;
};

/// Reads a mesh; the format is taken from the file's ending (any case). Faces with more than three corners
/// are triangulated without new points. STL repeats its points: equal ones (bit for bit) become one. Nothing
/// else is changed or repaired, non-finite coordinates included; see Polyhedron::find_defects for what is
/// then refused.
/// @return points in m as written.
/// @throws MeshFileError: missing, unreadable, unknown ending, malformed, truncated, index out of range,
/// coordinate beyond 1e150 (binary files: with the byte it begins at in the message), no faces.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);

/// The faces below one name in a file, with the points that they use.
struct MeshGroup {
  std::string name;
  TriangleMesh mesh;
};

/// Reads an OBJ file whose objects and groups are bodies of their own: faces that follow an `o` or `g`
/// statement belong to the name that it gives, faces before any to "default". Groups in the order in which
/// their first faces stand. Of an MSH file each physical group of its volume is a body. @throws MeshFileError as read_mesh, and for other formats, which have no groups
[[nodiscard]] std::vector<MeshGroup> read_mesh_groups(const std::filesystem::path& path);

}  // namespace ashlar

// Reads surface meshes (OFF, OBJ, STL, PLY; text and binary if the format has both), and the surfaces of volume
// meshes (MSH). For the supported parts of the formats see mesh_formats.hpp and volume_mesh.hpp.
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

/// Reads a mesh; the format is given by the file name extension (any case). Faces with more than three corners are
/// triangulated without new points. STL repeats its points: equal ones (bit for bit) are merged. Nothing else is
/// changed or repaired, including non-finite coordinates; for the defects refused later see Polyhedron::find_defects.
/// @return points in m as written.
/// @throws MeshFileError: missing, unreadable, unknown ending, malformed, truncated, index out of range,
/// coordinate beyond 1e150 (binary files: with the byte it begins at in the message), no faces.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);

/// The faces below one name in a file, with the points that they use.
struct MeshGroup {
  std::string name;
  TriangleMesh mesh;
};

/// Reads an OBJ file whose objects and groups are separate bodies: faces after an `o` or `g` statement belong to the
/// given name, faces before any to "default". Groups are in the order of their first faces. In an MSH file each
/// physical group of its volume is a body.
/// @throws MeshFileError as read_mesh, and for other formats, which have no groups
[[nodiscard]] std::vector<MeshGroup> read_mesh_groups(const std::filesystem::path& path);

}  // namespace ashlar

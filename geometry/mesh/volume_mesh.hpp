// Meshes of tetrahedra: Gmsh's MSH files, as text of versions 2.2 and 4.1, and the surfaces of what they hold.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Tetrahedra that share points.
struct VolumeMesh {
  std::vector<Vector3> points;                 ///< (#points), m as written; those of no tetrahedron too
  std::vector<std::array<int, 4>> tetrahedra;  ///< indices into points; the exact volume is positive
  std::vector<std::string>
      groups;                 ///< physical groups in the order of their first tetrahedra: names, or numbers
                              ///< of those without; "default": of none
  std::vector<int> group_of;  ///< (#tetrahedra), indices into groups
};

/// Reads the text of an MSH file. Points, lines and faces of the mesh are passed over, and so are sections that are
/// not of the mesh. Tetrahedra that are inside out are turned.
/// @throws MeshFileError with line and column: another version, a binary file, malformed or truncated text, an unknown
/// node, elements of the volume that are no tetrahedra with four nodes, a tetrahedron without volume, a volume in
/// several physical groups, no tetrahedra
[[nodiscard]] VolumeMesh read_msh(std::string_view text);

/// Whether the file's ending says so.
[[nodiscard]] bool is_volume_mesh(const std::filesystem::path& path);

/// Reads a file. @throws MeshFileError as read_msh, for a file that cannot be read, or with another ending than .msh
[[nodiscard]] VolumeMesh read_volume_mesh(const std::filesystem::path& path);

/// The tetrahedra of one physical group. @throws MeshFileError that lists the groups if there is none of that name
[[nodiscard]] VolumeMesh only_group(const VolumeMesh& mesh, const std::string& group);

/// The facets that bound one of the tetrahedra only, outward, with the points that they use in the order of the mesh.
/// @param chosen indices of tetrahedra. @throws MeshFileError for a facet of more than two of them
[[nodiscard]] TriangleMesh surface_of(const VolumeMesh& mesh, const std::vector<int>& chosen);
/// Of all tetrahedra.
[[nodiscard]] TriangleMesh surface_of(const VolumeMesh& mesh);

/// A body for each physical group: the surface of its tetrahedra.
[[nodiscard]] std::vector<MeshGroup> surfaces_of_groups(const VolumeMesh& mesh);

/// A body for each tetrahedron, called "1", "2", ...
[[nodiscard]] std::vector<MeshGroup> surfaces_of_tetrahedra(const VolumeMesh& mesh);

}  // namespace ashlar

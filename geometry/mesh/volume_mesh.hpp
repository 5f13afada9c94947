// Meshes of tetrahedra: Gmsh's MSH files, text and binary, of versions 2.0 to 2.2 and 4.1, and their surfaces. Files without
// tetrahedra contain these surfaces.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Tetrahedra that share points, or, of a file without any, triangles that bound bodies.
struct VolumeMesh {
  std::vector<Vector3> points;                 ///< (#points), m as written; those of no tetrahedron too
  std::vector<std::array<int, 4>> tetrahedra;  ///< indices into points; the exact volume is positive
  std::vector<std::array<int, 3>> triangles;   ///< indices into points, as written; none beside tetrahedra
  std::vector<std::string>
      groups;                 ///< physical groups in the order of their first elements: names, or numbers
                              ///< of those without; "default": of none
  std::vector<int> group_of;  ///< (#tetrahedra or #triangles), indices into groups
};

/// Reads a whole MSH file. Elements of second order are read by their corners: their edges become straight. Ignored
/// are points and lines of the mesh, triangles beside tetrahedra, and other sections. Inverted tetrahedra are reversed.
/// @throws MeshFileError with line and column, of a binary file with the byte: another version, malformed or
/// truncated text, inconsistent numbers of nodes or elements, an unknown node, a surface or volume missing in
/// $Entities, groups after the elements, elements of the volume other than tetrahedra with four or ten nodes, a
/// tetrahedron without volume or given twice, a volume in several physical groups; without tetrahedra: no triangles,
/// other elements of surfaces, a surface in several physical groups
[[nodiscard]] VolumeMesh read_msh(std::string_view text);

/// True if the file name extension is that of a volume mesh.
[[nodiscard]] bool is_volume_mesh(const std::filesystem::path& path);

/// Reads a file. @throws MeshFileError as read_msh, for a file that cannot be read, or with another ending than .msh
[[nodiscard]] VolumeMesh read_volume_mesh(const std::filesystem::path& path);

/// The tetrahedra, or triangles, of one physical group. @throws MeshFileError with a list of groups if there is none
/// of that name
[[nodiscard]] VolumeMesh only_group(const VolumeMesh& mesh, const std::string& group);

/// The facets that bound one of the tetrahedra only, outward, with the points that they use in the order of the mesh.
/// @param chosen indices of tetrahedra. @throws MeshFileError for a facet of more than two of them
[[nodiscard]] TriangleMesh surface_of(const VolumeMesh& mesh, const std::vector<int>& chosen);
/// The facets of all tetrahedra; the triangles themselves if there are none.
[[nodiscard]] TriangleMesh surface_of(const VolumeMesh& mesh);

/// A body for each physical group: the surface of its tetrahedra, or its triangles.
[[nodiscard]] std::vector<MeshGroup> surfaces_of_groups(const VolumeMesh& mesh);

/// A body for each tetrahedron, called "1", "2", ... @throws MeshFileError if there is none
[[nodiscard]] std::vector<MeshGroup> surfaces_of_tetrahedra(const VolumeMesh& mesh);

}  // namespace ashlar

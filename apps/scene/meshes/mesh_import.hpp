// Mesh files of all supported formats: those of geometry/mesh, and 3MF, DXF and glTF by the readers in this folder
// (gltf_reader, threemf_reader, dxf_reader), for the parts of these formats that contain triangles.
//
// Files are untrusted. The file name extension selects the reader, which accepts no other content. Time and memory
// are bounded by the bytes of the file (notes/mesh_import.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

/// Used in messages.
inline constexpr const char* readable_mesh =
    "a readable OFF, OBJ, STL, PLY, MSH, 3MF, DXF, glTF, ASC or XYZ file";

/// read_mesh of any format. For an imported file all objects, with their transformations; equal points are merged.
/// @throws MeshFileError as read_mesh
[[nodiscard]] TriangleMesh read_mesh_file(const std::filesystem::path& path);

/// read_mesh_groups of any format. For an imported file one group for each object (DXF: layer) with faces; of objects
/// with the same name those after the first get a number appended. @throws MeshFileError as above
[[nodiscard]] std::vector<MeshGroup> read_mesh_file_groups(const std::filesystem::path& path);

/// Warning of properties that an imported file does not define, its unit or upward direction; empty for other
/// formats.
[[nodiscard]] std::optional<std::string> import_warning(const std::filesystem::path& path);

}  // namespace ashlar

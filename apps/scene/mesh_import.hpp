// Mesh files of all formats that blocks may come from: those of geometry/mesh, and 3MF, DXF and glTF by the readers beside
// this one (gltf_reader, threemf_reader, dxf_reader), for the part of these formats that makes triangles.
//
// A file may be anyone's. Its ending chooses the reader, which takes no other content. Time and memory are bounded by the
// bytes of the file (notes/mesh_import.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_io.hpp"

namespace ashlar {

/// For messages.
inline constexpr const char* readable_mesh = "a readable OFF, OBJ, STL, PLY, MSH, 3MF, DXF or glTF file";

/// read_mesh of any format. Of an imported one all objects, with their transformations; equal points are one.
/// @throws MeshFileError as read_mesh
[[nodiscard]] TriangleMesh read_mesh_file(const std::filesystem::path& path);

/// read_mesh_groups of any format. Of an imported one a group for each object (DXF: layer) with faces; of objects with the
/// same name those after the first have their number behind it. @throws MeshFileError as above
[[nodiscard]] std::vector<MeshGroup> read_mesh_file_groups(const std::filesystem::path& path);

/// A warning of what an imported file does not say, its unit or which way is up; none of other formats.
[[nodiscard]] std::optional<std::string> import_warning(const std::filesystem::path& path);

}  // namespace ashlar

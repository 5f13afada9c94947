// Mesh files of all formats that blocks may come from: those of geometry/mesh, and 3MF, DXF and glTF through the Open
// Asset Import Library (assimp), where the program is built with it.
//
// assimp is less strict than our readers: it gives no place of an error, and passes over what it does not know. It has
// coordinates in single precision, drops names of 3MF objects (they are Object_1, Object_2 ...) and the unit of 3MF files,
// and turns DXF drawings so that y is up, which is taken back here: coordinates are those of the file.
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
/// @throws MeshFileError as read_mesh; also "built without assimp"
[[nodiscard]] TriangleMesh read_mesh_file(const std::filesystem::path& path);

/// read_mesh_groups of any format. Of an imported one a group for each object (DXF: layer) with faces; of objects with the
/// same name those after the first have their number behind it. @throws MeshFileError as above
[[nodiscard]] std::vector<MeshGroup> read_mesh_file_groups(const std::filesystem::path& path);

/// What to know of an imported file: precision, unit, direction; none of other formats.
[[nodiscard]] std::optional<std::string> import_warning(const std::filesystem::path& path);

/// Version of assimp; empty: built without it.
[[nodiscard]] std::string assimp_version();

}  // namespace ashlar

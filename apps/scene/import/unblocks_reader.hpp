// Blocks of UnBlocks-gen, which cuts rock by joints: its files for DDA (.dda, "#_DDA_DataFile_Version_1.0").
//
// Read: points, faces, blocks that are fixed (fixedFlag), bonds. Boundaries of other kinds (Viscous, Roller, Input,
// FixFace) are left out. Blocks are numbered from 0, as in the file.
#pragma once

#include <string_view>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

/// @throws MeshFileError with line and column: no such file, a section that is missing or ends early, an index out of
/// range, a face with fewer than three corners
[[nodiscard]] ImportedModel read_unblocks(std::string_view text);

}  // namespace ashlar

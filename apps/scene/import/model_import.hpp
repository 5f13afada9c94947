// Files of other programs as models, the reader chosen by the name of the file.
//
// Files are untrusted; time and memory are bounded by their bytes. Readers: compas_reader (.json), poly_reader (3DEC:
// .dat, .3ddat, .3dec), lmgc90_reader (BODIES.DAT and the files beside it), unblocks_reader (.dda).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

/// A model with a scene for it.
struct ImportedScene {
  std::string scene;      ///< text of the scene file
  std::string blocks;     ///< text of the OBJ file beside it; empty if the scene names the file itself
  std::size_t count = 0;  ///< blocks; 0 if the scene names the file itself
  std::vector<std::string> left_out;  ///< parts of the files that the scene lacks
  std::vector<std::string> notes;     ///< what else a user should know
};

/// Reads a model. Of a mesh file (OBJ, MSH, ...) the scene names the file itself, with a block for each group, or for each
/// closed surface of a format without groups. A folder is one of LMGC90: it, or DATBOX in it, holds BODIES.DAT.
/// @param file as the user named it, for messages too. @param scene where the scene will be written; the OBJ file has its
/// name with the ending .obj
/// @param fixed names or globs of blocks that never move, besides those that the file holds
/// @throws ImportError with the place: a file that cannot be read, of a format that has to be converted first (IFC, 3DM,
/// STEP: the message names the way), or of an unknown one
[[nodiscard]] ImportedScene import_model(const std::filesystem::path& file,
                                         const std::filesystem::path& scene,
                                         const std::vector<std::string>& fixed = {});

}  // namespace ashlar

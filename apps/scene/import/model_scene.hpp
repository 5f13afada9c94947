// An imported model as a scene: the text of a scene file, and of the OBJ file with its blocks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

/// The name before those of the blocks: a block 7 of a model is block.7 in the scene.
inline constexpr const char* imported_prefix = "block";

/// Young's modulus of materials, which rigid blocks need for the stiffness of springs alone, Pa. Statics without given
/// stiffness hold joints by multipliers, and do not use it.
inline constexpr double imported_modulus = 1e10;
/// Where a file gives no density, kg/m^3: of limestone and brickwork alike. Equilibrium under weight alone is the same for
/// any that all blocks have.
inline constexpr double imported_density = 2400.0;

/// Accepted overlap of blocks over the rounding of their coordinates: a corner of each of two blocks is off by up to
/// sqrt(3) of it, together 3.5.
inline constexpr double overlap_of_rounding = 4.0;

/// The scene, a static analysis of rigid blocks. Supports that move reach their displacement at its end, 1 s.
/// @param source the imported file, for a comment. @param mesh OBJ file, relative to the scene
/// @param split of that file into blocks, as mesh.split
[[nodiscard]] std::string scene_of(const ImportedModel& model, const std::string& source,
                                   const std::filesystem::path& mesh, const char* split);

/// An [[assign]] that holds blocks. @param blocks names or globs without the prefix
[[nodiscard]] std::string fixed_blocks(const std::vector<std::string>& blocks);

/// An object for each block. Coordinates are exact to the last bit.
[[nodiscard]] std::string obj_of(const ImportedModel& model);

/// A text as TOML in quotes.
[[nodiscard]] std::string quoted(const std::string& text);

}  // namespace ashlar

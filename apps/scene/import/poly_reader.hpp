// Data files of 3DEC up to version 4: blocks of the command `poly`, with `brick`, `prism` and `face`.
//
// Read besides: `property` of materials (density) and of joint material 1 (stiffness, friction, cohesion, tension), `change
// mat`, `fix`, `gravity`, and ranges of `region`, `x`, `y`, `z`, `nrange` and `union` (a block is in x, y, z by its
// centroid). Other commands are left out and listed; those that change the geometry (`jset`, `tunnel`, `delete`, `call`,
// ...) are refused. Blocks of a region R are called rR_K, others K, K being their number in the file.
//
// Coordinates of a file with four decimals and more count as rounded to its last decimal.
#pragma once

#include <string_view>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

/// @throws MeshFileError with line and column: no `poly` in the file, a malformed command, a command that changes the
/// geometry
[[nodiscard]] ImportedModel read_poly(std::string_view text);

}  // namespace ashlar

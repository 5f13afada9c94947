// Names of blocks, and those that pieces of cut blocks have besides (piece_names.hpp).
#pragma once

#include <cstddef>
#include <string>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// The name of the block that cuts divided into pieces, of one of them; empty: the block is no piece.
[[nodiscard]] std::string name_before_cuts(const Scene& scene, std::size_t block);

/// True if a glob matches the name of a block or another name of it as a piece, or is the name of the block before the cuts.
[[nodiscard]] bool pattern_names_block(const Scene& scene, const std::string& pattern, std::size_t block);

/// The name of the block that a measure means by another name of a piece; any other name is returned unchanged.
[[nodiscard]] std::string own_name(const Scene& scene, const std::string& name);

}  // namespace ashlar

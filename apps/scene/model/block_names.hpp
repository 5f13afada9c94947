// Names of blocks, and those that pieces of cut blocks have besides (piece_names.hpp).
#pragma once

#include <cstddef>
#include <string>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// True if a glob matches the name of a block or another name of it as a piece.
[[nodiscard]] bool pattern_names_block(const Scene& scene, const std::string& pattern, std::size_t block);

/// The name of the block that a measure means by another name of a piece; any other name is returned unchanged.
[[nodiscard]] std::string own_name(const Scene& scene, const std::string& name);

}  // namespace ashlar

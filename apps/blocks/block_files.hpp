// The blocks of a scene as files: blocks.vtu for ParaView, blocks.obj for programs that model.
#pragma once

#include <string>
#include <vector>

#include "apps/blocks/removable_blocks.hpp"
#include "apps/results/vtu_writer.hpp"

namespace ashlar {

/// Triangles of all blocks with `block` (its index), `volume`
/// and, if blocks were looked at, `mode` (BlockMode as a number, -1: not looked at) and
/// `factor_of_safety` (-1: not looked at).
[[nodiscard]] UnstructuredGrid block_grid(const BlockReport& report,
                                          const std::vector<RemovableBlock>& removable);

/// Wavefront OBJ: an object and a group for each block, coordinates as they are to the last bit.
[[nodiscard]] std::string block_obj(const LoadedScene& loaded);

}  // namespace ashlar

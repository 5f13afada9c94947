// The blocks of a scene as files: blocks.vtu for ParaView, blocks.obj and blocks.stl for modelling programs,
// blocks.msh for Gmsh and compatible programs.
#pragma once

#include <string>
#include <vector>

#include "apps/program/blocks/removable_blocks.hpp"
#include "apps/results/frames/vtu/vtu_writer.hpp"

namespace ashlar {

/// Triangles of all blocks with `block` (its index), `volume` and, if blocks were examined, `mode` (BlockMode as a
/// number, -1: not examined) and `factor_of_safety` (-1: not examined).
[[nodiscard]] UnstructuredGrid block_grid(const BlockReport& report,
                                          const std::vector<RemovableBlock>& removable);

/// Wavefront OBJ: an object and a group for each block, coordinates exact to the last bit.
[[nodiscard]] std::string block_obj(const LoadedScene& loaded);

/// STL as text: a solid for each block, coordinates exact to the last bit. STL has no unit: these are m.
[[nodiscard]] std::string block_stl(const LoadedScene& loaded);

/// MSH 2.2 as text: the triangles of each block are a physical group of dimension 2 with its name and number, from 1,
/// and points of their own.
[[nodiscard]] std::string block_msh(const LoadedScene& loaded);

}  // namespace ashlar

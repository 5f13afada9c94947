// Names of the pieces of a cut block.
//
// NAME.1, NAME.2, ... are the pieces outside of the solids of cuts, NAME.inside.1, ... those inside. If several cuts by
// solids have pieces of a block inside, those of cut C are NAME.C.inside.1, ..., of the last one that contains them.
//
// A piece has other names too, which may be used wherever blocks are named: those above; NAME.C.inside.K, the K-th of
// all pieces inside the solid of cut C; NAME.C.K, the K-th of all pieces with a face made by cut C, for a solid of those
// outside. Cuts named "inside" give none.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// The name of each piece of a block, in order. A block that no cut has parted keeps its name.
/// @param block index of scene.block before it is cut, with a solid in the rock
[[nodiscard]] std::vector<std::string> piece_names(const Scene& scene, const CutRock& rock,
                                                   std::size_t block);

/// The other names of each piece; none for a block that no cut has parted.
[[nodiscard]] std::vector<std::vector<std::string>> other_piece_names(const Scene& scene, const CutRock& rock,
                                                                      std::size_t block);

}  // namespace ashlar

// Executes the cuts of a scene: blocks become pieces.
#pragma once

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/preparation.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Cuts the blocks of a scene by its cuts, one after the other, and replaces them by the pieces: NAME.1, NAME.2 ...
/// in order; those inside the solid of a cut NAME.inside.1 ... Blocks that are not divided are unchanged. A glob of a
/// cut matches a block by the block's name, otherwise those of its pieces whose names at that time match. Measures of
/// a cut block move to the piece with their point. All other keys of blocks are transferred to pieces, and places
/// refer to the blocks' keys; [[assign]]s to pieces are applied later (apply_assignments_to_pieces).
/// Sets Scene::uncut and Scene::rock. Adds a tied joint for each glued cut after all others, and the joint of each
/// bonded cut before all others, so that these override it; a bonded cut that makes no face between two blocks is a
/// fault. No effect without cuts.
void cut_scene(Scene& scene, Diagnostics& diagnostics, Preparation* preparation = nullptr);

}  // namespace ashlar

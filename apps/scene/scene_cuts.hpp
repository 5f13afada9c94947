// The cuts of a scene made: blocks become pieces.
#pragma once

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/preparation.hpp"
#include "apps/scene/scene.hpp"

namespace ashlar {

/// Cuts the blocks of a scene by its cuts, one after the other, and puts the pieces in their place: NAME.1,
/// NAME.2 ... in order; those inside the solid of a cut NAME.inside.1 ... A block that nothing parted stays
/// as it is. A glob of a cut means a block if it matches the block's name, else those of its pieces whose
/// names at that time it matches. Measures of a block that was cut move to the piece that has their point.
/// Everything else that a key can say of blocks is then said of pieces, and places lead to the blocks' keys;
/// [[assign]]s to pieces are still to be made (apply_assignments_to_pieces).
/// Sets Scene::uncut and Scene::rock, and adds a tied joint for each glued cut. Does nothing without cuts.
void cut_scene(Scene& scene, Diagnostics& diagnostics, Preparation* preparation = nullptr);

}  // namespace ashlar

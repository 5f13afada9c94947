// Glues pieces that are too small for a model to their neighbours.
#pragma once

#include "geometry/cutting/cut_solid.hpp"

namespace ashlar {

/// Glues each piece below a volume to the neighbour of the same label with the largest common area (the first in
/// number of equal ones), the smallest piece first (the first in order of equal ones), until none with a neighbour is
/// left. The result may still be too small, and is glued in turn.
/// @param chosen pieces that may be glued to others. @return number of glued pieces
int glue_small_pieces(CutSolid& solid, double volume, const CutSolid::Choice& chosen);

}  // namespace ashlar

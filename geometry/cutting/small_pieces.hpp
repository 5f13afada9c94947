// Pieces that are too small for a model, glued to their neighbours.
#pragma once

#include "geometry/cutting/cut_solid.hpp"

namespace ashlar {

/// Glues each piece below a volume to the neighbour of the same label that it shares most area with (of equal
/// ones the first in number), the smallest piece first (of equal ones the first in order), until none is left
/// that has a neighbour. What comes about may still be too small, and is glued in its turn.
/// @param chosen pieces that may be glued to others @return how many were
int glue_small_pieces(CutSolid& solid, double volume, const CutSolid::Choice& chosen);

}  // namespace ashlar

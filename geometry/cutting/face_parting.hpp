// A face of any shape divided along the line in which a plane goes through it. Only sources of this layer include this
// file.
#pragma once

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// The face becomes all connected parts of it on either side of the plane. @pre it has points on both sides
void part_face(CellComplex& complex, int face, int plane);

}  // namespace ashlar

// Division of a face of any shape along its line of intersection with a plane. Only sources of this layer include
// this file.
#pragma once

#include "geometry/cutting/cell_complex.hpp"

namespace ashlar {

/// Replaces the face by its connected parts on either side of the plane. @pre it has points on both sides
void part_face(CellComplex& complex, int face, int plane);

}  // namespace ashlar

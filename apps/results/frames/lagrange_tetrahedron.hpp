// Tetrahedra with a polynomial of any order: VTK's Lagrange tetrahedra (cell type 71), as lagrange_triangle.hpp for
// triangles. A block of order n is a polynomial of degree n, so that its values at the (n+1)(n+2)(n+3)/6 lattice
// points of a tetrahedron determine it.
#pragma once

#include <array>
#include <vector>

#include "apps/results/frames/simplex_lattice.hpp"

namespace ashlar {

using TetrahedronWeights = std::array<int, 4>;  ///< of the four corners; not negative, their sum is the order

/// The lattice points in VTK's order: the corners; the inner points of the sides 0 to 1, 1 to 2, 2 to 0, 0 to 3, 1 to
/// 3 and 2 to 3; those of the faces 0 1 3, 2 3 1, 0 3 2 and 0 2 1, each as a triangle of order n - 3; then the inner
/// points in the same way, as a tetrahedron of order n - 4. @param order at least 1
[[nodiscard]] std::vector<TetrahedronWeights> tetrahedron_nodes(int order);

/// The pieces^3 small tetrahedra of equal volume between lattice points, with the orientation of the large one: the
/// part in one corner of Kuhn's division of cubes. Each face is divided into pieces^2 triangles as by
/// lattice_triangles, so that neighbours conform.
/// @return indices into tetrahedron_nodes(pieces)
[[nodiscard]] std::vector<std::array<int, 4>> lattice_tetrahedra(int pieces);

}  // namespace ashlar

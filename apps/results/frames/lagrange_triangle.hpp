// Triangles with a polynomial of any order: VTK's Lagrange triangles (cell type 69). A face of a block of order n is
// a polynomial of degree n on each flat triangle of the undeformed block, so that its values at the (n+1)(n+2)/2
// lattice points of the triangle determine it.
//
// A lattice point of order n is a triple of whole weights (i, j, k), i + j + k = n, and lies at
// (i A + j B + k C) / n of the triangle A B C.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "apps/results/frames/simplex_lattice.hpp"

namespace ashlar {

using LatticeWeights = std::array<int, 3>;  ///< of the three corners; not negative, their sum is the order

/// The lattice points in VTK's order: the corners; the inner points of the sides A to B, B to C and C to A;
/// then those inside in the same way, as a triangle of order n - 3. @param order at least 1
[[nodiscard]] std::vector<LatticeWeights> lagrange_nodes(int order);

/// Values of the shape functions of lagrange_nodes(order) at a point: C(n a, i) C(n b, j) C(n c, k) with the
/// generalised binomial C(z, i) = z (z - 1) ... (z - i + 1) / i!. @param share of A, B and C; their sum is 1
[[nodiscard]] std::vector<double> lagrange_values(int order, const std::array<double, 3>& share);

/// The order^2 small triangles between lattice points, with the orientation of the large one.
/// @return indices into lagrange_nodes(order)
[[nodiscard]] std::vector<std::array<int, 3>> lattice_triangles(int order);

/// The lattice points of triangles that share corners.
using SharedLattice = SimplexLattice<3>;

/// @param corners of each triangle; equal numbers mean the same corner
[[nodiscard]] SharedLattice shared_lattice(const std::vector<std::array<int, 3>>& corners, int order);

}  // namespace ashlar

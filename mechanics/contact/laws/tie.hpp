// Tied blocks: the gap over their common faces.
//
// Both blocks are polynomials on the common faces, and so is the gap x_a - x_b. With psi orthonormal on the common
// faces it is  sum_k psi_k g_k,
//     g = A q_a - B q_b,   integral of |x_a - x_b|^2 dA = |g|^2,
// exactly, with constant matrices A and B. Springs of stiffness k per area in all directions have the energy 1/2 k
// |g|^2. It is invariant when both blocks move as one rigid body, its forces have no torque, and the blocks become
// conforming as k grows.
#pragma once

#include <Eigen/Dense>

#include "mechanics/basis/basis.hpp"

namespace ashlar {

/// A, B and the size of the common faces.
struct Tie {
  Eigen::MatrixXd a;  ///< A, (r, functions of a), m^-1/2
  Eigen::MatrixXd b;  ///< B, (r, functions of b)
  double area = 0.0;  ///< m^2, of the undeformed blocks; 0: no common face, then r = 0
};

/// Faces are common if they are coplanar within allowed_offset (face_selection.hpp), face each other and overlap, in
/// part or whole.
[[nodiscard]] Tie tie_between(const Polyhedron& solid_a, const PolynomialBasis& basis_a,
                              const Polyhedron& solid_b, const PolynomialBasis& basis_b);

}  // namespace ashlar

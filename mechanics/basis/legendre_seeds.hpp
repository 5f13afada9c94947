// Products of Legendre polynomials over a solid, in 50 digits: what a basis is made from. Only sources of this
// folder include this file.
//
// The seeds are L_a(xi) L_b(eta) L_c(zeta), by monomial_index(a, b, c); phi = inverse(L) seed, L L' the Gram
// matrix of the seeds over the solid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/eigen.hpp>
#include <vector>

#include "geometry/exact/fifty_digits.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ashlar {

using Real = FiftyDigits;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using RealPoints = std::vector<std::array<Real, 3>>;

/// Integrals of the monomials of the given coordinates over the solid they bound, a + b + c <= degree.
[[nodiscard]] std::vector<Real> monomial_moments(const RealPoints& points, const TriangleMesh& mesh,
                                                 int degree);

/// Lower triangle of the Gram matrix of the seeds. @param moments of monomials up to degree 2 order
/// @return (p, p)
[[nodiscard]] RealMatrix gram_matrix(const std::vector<Real>& moments, int order);

/// @param failed set to the first row that is no longer positive; -1: none
[[nodiscard]] RealMatrix cholesky_factor(RealMatrix matrix, Eigen::Index& failed);
[[nodiscard]] RealMatrix inverse_of_lower(const RealMatrix& lower);

/// inverse(L) S L with S the derivative of the seeds by one xi. @return (p, p), rounded
[[nodiscard]] Eigen::MatrixXd derivative_matrix(const RealMatrix& lower, const RealMatrix& inverse, int order,
                                                int axis);

/// Which function is multiplied, and which weights of the product are asked for.
struct SeedProduct {
  int axis;    ///< of the xi that multiplies
  int parent;  ///< the function
  int first;   ///< weights from this function
  int last;    ///< to this one
};

/// The weights of xi_axis phi_parent in the basis, from the first to the last asked for. @param exponents of the seeds
/// @return (last - first + 1)
[[nodiscard]] std::vector<Real> multiplied(const RealMatrix& lower, const RealMatrix& inverse,
                                           const std::vector<std::array<int, 3>>& exponents,
                                           const SeedProduct& product);

/// Seeds at a point. @return (p)
[[nodiscard]] std::vector<Real> seed_values(const std::array<Real, 3>& xi, int order);

}  // namespace ashlar

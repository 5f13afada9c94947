// Products of Legendre polynomials over a solid, from which a basis is computed, in 32 digits (double_double.hpp) if
// these are proven to suffice, else in 50. Only sources of this folder include this file.
//
// The seeds are L_a(xi) L_b(eta) L_c(zeta), by monomial_index(a, b, c); phi = inverse(L) seed, L L' the Gram
// matrix of the seeds over the solid. Real is ExtendedDouble or FiftyDigits.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/eigen.hpp>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mechanics/basis/double_double.hpp"

namespace ashlar {

template <class Real>
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
template <class Real>
using RealPoints = std::vector<std::array<Real, 3>>;

/// Integrals of the monomials of the given coordinates over the solid they bound, a + b + c <= degree.
template <class Real>
[[nodiscard]] std::vector<Real> monomial_moments(const RealPoints<Real>& points, const TriangleMesh& mesh,
                                                 int degree);

/// Size of the monomial moments without cancellation: all products and sums of monomial_moments() with their absolute
/// values. Coordinates with a relative error e give moments with an error of at most (3 degree + 12) (e + unit
/// roundoff) of these. @param points rounded
[[nodiscard]] std::vector<double> moment_sizes(const std::vector<Vector3>& points, const TriangleMesh& mesh,
                                               int degree);

/// Integrals of the seeds of all degrees of the monomial moments.
template <class Real>
[[nodiscard]] std::vector<Real> legendre_moments(const std::vector<Real>& monomial_moments, int degree);

/// Largest integral of a seed with the absolute values of all terms.
[[nodiscard]] double legendre_size(const std::vector<double>& moment_sizes, int degree);

/// Lower triangle of the Gram matrix of the seeds: products of seeds are sums of seeds with positive weights of sum
/// 1, so that the error of an entry is at most that of the moments. @param legendre_moments up to degree 2 order
/// @return (p, p)
template <class Real>
[[nodiscard]] RealMatrix<Real> gram_matrix(const std::vector<Real>& legendre_moments, int order);

/// @param failed set to the first row that is no longer positive; -1: none
template <class Real>
[[nodiscard]] RealMatrix<Real> cholesky_factor(RealMatrix<Real> matrix, Eigen::Index& failed);
template <class Real>
[[nodiscard]] RealMatrix<Real> inverse_of_lower(const RealMatrix<Real>& lower);

/// inverse(L) S L with S the derivative of the seeds by one xi. @return (p, p), rounded
template <class Real>
[[nodiscard]] Eigen::MatrixXd derivative_matrix(const RealMatrix<Real>& lower,
                                                const RealMatrix<Real>& inverse, int order, int axis);

/// A function to be multiplied, and the range of weights of the product.
struct SeedProduct {
  int axis;    ///< of the xi that multiplies
  int parent;  ///< the function
  int first;   ///< weights from this function
  int last;    ///< to this one
};

/// The requested weights of xi_axis phi_parent in the basis. @param exponents of the seeds
/// @return (last - first + 1)
template <class Real>
[[nodiscard]] std::vector<Real> multiplied(const RealMatrix<Real>& lower, const RealMatrix<Real>& inverse,
                                           const std::vector<std::array<int, 3>>& exponents,
                                           const SeedProduct& product);

/// Seeds at a point. @return (p)
template <class Real>
[[nodiscard]] std::vector<Real> seed_values(const std::array<Real, 3>& xi, int order);

}  // namespace ashlar

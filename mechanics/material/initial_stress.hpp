// Stress that is in a block before it deforms: in rock, that of the ground.
//
//   find d:  integral of Hooke(grad d) : grad v dV = integral of s : grad v dV   for all v of the block's polynomials
// The block is elastic about the shape X - d(X) in place of X, so that at X its stress is s wherever its polynomials
// can have it (theory.md section 4). A stress that they cannot have is replaced by the one with the same forces on all
// motions of the block: one of order 1 has the mean of s.
#pragma once

#include <Eigen/Dense>
#include <functional>

#include "geometry/solid/polyhedron.hpp"
#include "mechanics/basis/basis.hpp"

namespace ashlar {

/// Cauchy stress at a point of the placed block, Pa, tension positive, symmetric. @param point m
using StressField = std::function<Eigen::Matrix3d(const Vector3& point)>;

/// Coefficients of d. Integrals are exact for stresses that are polynomials of degree 4.
/// @param stiffness elastic_stiffness() of the block, (3p, 3p). @return (p, 3), without rigid motion
[[nodiscard]] Eigen::MatrixX3d initial_deformation(const Polyhedron& solid, const PolynomialBasis& basis,
                                                   const Eigen::MatrixXd& stiffness,
                                                   const StressField& stress);

}  // namespace ashlar

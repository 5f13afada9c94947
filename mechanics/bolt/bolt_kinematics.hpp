// The deformation of a bolt from the places of its points in the blocks.
//
// Grouted: pieces turn with their blocks, t_k the direction of piece k. The distance along the bar from its first point
// to point j of piece k is
//
//   S_kj = S_k0 + t_k . (x_kj - x_k0),   S_k0 = S_(k-1)p + t . g
//
// with g from the last point of piece k - 1 to the first of piece k and t the mean direction of both. Where it is
// dowelled, the bar is sheared across t by q = (n_1 . g, n_2 . g), with n_1, n_2 carried along with piece k - 1. Ends:
// the distance of both points. The deformation is S less its value in the blocks as placed, for all points, then q for
// all dowelled crossings; or the change of the distance alone.
//
// It does not change if all points move as one rigid body. Its derivative includes that of t and n_i, so that the
// forces of a crossing that is sheared or open have neither a resultant nor a torque. It leaves out the turning of t_k
// within a piece that is curved, which is of second order in the curvature.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "mechanics/bolt/bolt_shape.hpp"

namespace ashlar {

/// Where the points of a bolt are.
struct BoltPlaces {
  Eigen::Matrix3Xd points;                 ///< (3, #points), m
  std::vector<Eigen::Matrix3d> gradients;  ///< by piece: mean deformation gradient of its block
};

/// Number of deformations.
[[nodiscard]] int deformation_count(const BoltShape& shape);
/// m, (#deformations).
[[nodiscard]] Eigen::VectorXd bolt_deformation(const BoltShape& shape, const BoltPlaces& places);
/// Derivative of the deformation with respect to the points, x, y, z of the first one first.
/// @return (#deformations, 3 #points)
[[nodiscard]] Eigen::MatrixXd bolt_rows(const BoltShape& shape, const BoltPlaces& places);

}  // namespace ashlar

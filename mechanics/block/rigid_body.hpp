// Rigid blocks, of order 0: position and velocity have the coefficients of order 1, x = c + R (X - X_c), so that
// contacts, loads and results treat them like other blocks. Their motion in a step has 6 degrees of freedom.
//
// Between two rigid positions x0 and x1 with xm = (x0 + x1) / 2 there are a spin s (Cayley's) and a translation d
// with
//
//   x1 - x0 = d + s x (xm - c_m)                c_m the centroid of xm
//
// for all points: the change of a step is one of the rigid velocity fields at its middle. Equations of motion
// projected on these fields conserve energy apart from the work of the applied forces, and change the angular
// momentum by their torque, exactly and for any length of the step (Simo and Wong, 1991): the reaction that keeps a
// block rigid is orthogonal to the fields.
#pragma once

#include <Eigen/Dense>

namespace ashlar {

/// Degrees of freedom of a rigid block.
inline constexpr int rigid_freedom = 6;

/// An orthonormal basis of the rigid velocity fields of a position: three translations, three rotations about the
/// centroid. The first function of the basis is constant and the others have mean zero. In it the mass matrix of the
/// block stays its density times the unit matrix. @param position (p, 3), not collinear
/// @return (3p, 6), coefficients stacked as in elasticity.hpp
[[nodiscard]] Eigen::MatrixXd rigid_fields(const Eigen::MatrixX3d& position);

/// Coefficients of the function 1 in a basis whose first function is constant and of norm 1.
/// @param size of the basis. @param volume of the block, m^3. @return (size)
[[nodiscard]] Eigen::VectorXd constant_function(Eigen::Index size, double volume);

/// The velocity field of a translation and of a rotation about a place.
/// @param position (p, 3). @param volume of the block, m^3. @return (p, 3)
[[nodiscard]] Eigen::MatrixX3d rigid_velocity(const Eigen::MatrixX3d& position, double volume,
                                              const Eigen::Vector3d& about,
                                              const Eigen::Vector3d& translation,
                                              const Eigen::Vector3d& rotation);

/// The rigid change closest to a change of position: the best-fit spin about the middle of the change. A rigid change
/// is reproduced. Its rounding errors are those of the change, not of the position.
/// @param position of a rigid block, (p, 3). @param change (p, 3). @return (p, 3)
[[nodiscard]] Eigen::MatrixX3d rigid_change(const Eigen::MatrixX3d& position, const Eigen::MatrixX3d& change);

}  // namespace ashlar

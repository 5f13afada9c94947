// Quiet faces: faces behind which the material of the block goes on without end (Lysmer and Kuhlemeyer 1969). Waves
// leave the block there.
//
//   t = -rho c_p (n . v) n - rho c_s (v - (n . v) n),   rho c_p = sqrt(rho (lambda + 2 mu)), rho c_s = sqrt(rho mu)
//
// v: velocity of the face, n: its outward normal, as placed. Plane waves along n are absorbed completely, others in
// part. As forces on the coefficients, for velocities of coefficients V stacked as in elasticity.hpp:
//   -C V,   C = sum over faces of  (n n' rho c_p + (1 - n n') rho c_s) (x) integral of phi_a phi_b dA.
// A wave that comes from behind with the velocity w adds the traction 2 (rho c_p n n' + rho c_s (1 - n n')) w: half of
// it moves the dashpots.
//
// Dashpots resist no constant force. Without motion a block with quiet faces is therefore held at them, as by supports.
// When motion begins, the reaction of these supports stays as a constant force.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "mechanics/basis/basis.hpp"
#include "mechanics/material/material.hpp"
#include "mechanics/supports/face_selection.hpp"
#include "mechanics/supports/loads.hpp"

namespace ashlar {

/// Quiet faces of a block, and what drives them.
struct QuietFaces {
  BlockPlace where;                                     ///< faces in a plane, or by index; not a point
  std::array<bool, 3> components = {true, true, true};  ///< of the displacement, held without motion
  std::vector<Load> driving = {};  ///< tractions of waves from behind: act in motion only
};

/// Velocity of a wave over time, by components along x, y and z, m/s.
using WaveVelocity = std::array<History, 3>;

/// Traction that a velocity of a face along each axis requires.
/// @param normal unit. @return symmetric, positive definite, Pa s/m
[[nodiscard]] Eigen::Matrix3d impedance(const Material& material, const Vector3& normal);

/// C. @return (3p, 3p), symmetric, positive semi-definite, Pa s/m^2
/// @throws std::invalid_argument if a place has no face of the solid
[[nodiscard]] Eigen::MatrixXd dashpot_matrix(const Polyhedron& solid, const PolynomialBasis& basis,
                                             const Material& material, const std::vector<QuietFaces>& quiet);

/// Tractions of a wave that enters at faces of one normal. A component without rows, or with zeros alone, has none.
/// @param faces indices, of one plane and side
[[nodiscard]] std::vector<Load> wave_loads(const Polyhedron& solid, const std::vector<int>& faces,
                                           const Material& material, const WaveVelocity& velocity);

/// Faces in a plane whose outward normals are along its normal, increasing. @throws as faces_in_plane
[[nodiscard]] std::vector<int> outer_faces(const Polyhedron& solid, const Plane& plane);

}  // namespace ashlar

// The incremental formulation, the paper's (theory.md section 1), kept as a baseline: a step's displacement
// is a polynomial of order n in the coordinates x of the step's start,
//
//   u(x) = sum_a phi_a(x) D_a,   phi orthonormal on the block as its flat sub-faces bound it now
//   sigma(x) = sum_b phi_b(x) s_b + Hooke(u)                   stress coefficients s, (p, 6)
//   E = 1/2 integral of sigma : inverse(C) sigma dV = 1/2 sum_b sigma_b : inverse(C) sigma_b
//   dE/dD_aj = sum_i,b (D_i)_ab sigma_b,ij                      D_i the derivative matrices of the basis
//
// At the end of a step the vertices of the sub-faces, and other points that are asked for, move by u. Volume,
// basis, supports and loads are taken anew on the moved sub-faces; stress and velocity keep their polynomials
// about the centroid: f(x) becomes f(x - s) with s the centroid's motion, but 0 along components that a
// support holds, so that what vanished on the support still does. Stress is neither turned nor mapped
// otherwise and density stays, so that the mass follows the volume: volume grows by 1 + t^2 in a step that
// turns the block by t, and stress is not objective. These are the faults of the formulation, not of this
// program; energies jump with them, which the ledger shows as residual.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <map>
#include <memory>
#include <vector>

#include "geometry/subfaces/sub_face_surface.hpp"
#include "mechanics/basis/basis.hpp"
#include "mechanics/block/block_definition.hpp"
#include "mechanics/material/elasticity.hpp"

namespace ashlar {

/// All that an incremental block is at the start of a step, beside its velocity.
struct CarriedShape {
  std::vector<Vector3> points;    ///< of the sub-faces, current coordinates, m
  std::vector<Vector3> followed;  ///< other points, m
  Eigen::MatrixXd stress;         ///< s, (p, 6): xx, yy, zz, xy, yz, xz; Pa m^3/2
};

/// What stays of an incremental block from step to step. Constant after construction.
class IncrementalForm {
 public:
  /// Divides the faces of a block of order >= 2.
  /// @throws std::invalid_argument for St.-Venant-Kirchhoff elasticity, which has no incremental form, or a
  /// plane without a face
  explicit IncrementalForm(const BlockDefinition& definition);

  /// Undeformed, without stress.
  [[nodiscard]] CarriedShape start() const;
  /// The block as it is now: supports and loads of planes on the faces that were in them at first, those at
  /// points where the points are now. @throws std::invalid_argument if the block has turned inside out
  [[nodiscard]] BlockDefinition definition_at(const CarriedShape& shape) const;

  /// Whole or divided faces with the points of the undeformed block; point k is CarriedShape::points[k].
  [[nodiscard]] const SubFaceSurface& surface() const { return surface_; }
  /// Where a material point is now. @param reference one of the sub-faces' points or of those that are
  /// followed, bit for bit. @throws std::invalid_argument for others: their motion is not known
  [[nodiscard]] const Vector3& place(const CarriedShape& shape, const Vector3& reference) const;

 private:
  BlockDefinition definition_;  ///< undeformed; planes as lists of faces
  SubFaceSurface surface_;
  std::vector<Vector3> followed_;               ///< undeformed: asked for, of supports, of loads
  std::map<std::array<double, 3>, int> index_;  ///< of points, then of followed ones, by coordinates
};

/// Stress that a change D of the coefficients adds. @param change (p, 3). @return (p, 6), as
/// CarriedShape::stress
[[nodiscard]] Eigen::MatrixXd added_stress(const PolynomialBasis& basis, const Material& material,
                                           const Eigen::MatrixX3d& change);

/// Energy and force at a change D; the frame is the identity. @param stress (p, 6), at the step's start
[[nodiscard]] ElasticResponse incremental_response(const PolynomialBasis& basis, const Material& material,
                                                   const Eigen::MatrixXd& stress,
                                                   const Eigen::MatrixX3d& change);

/// Stress where the functions have these values. @param stress (p, 6). @param values (p). @return (3, 3), Pa, tension
/// positive
[[nodiscard]] Eigen::Matrix3d incremental_stress(const Eigen::MatrixXd& stress,
                                                 const Eigen::VectorXd& values);

/// T with  sum_b psi_b(x) (T c)_b = sum_a phi_a(x - shift) c_a  for all c: polynomials moved along, in the
/// basis of the moved block. @param from phi, @param to psi, of the same order. @return (p, p)
[[nodiscard]] Eigen::MatrixXd re_expansion(const PolynomialBasis& from, const PolynomialBasis& to,
                                           const Vector3& shift);

}  // namespace ashlar

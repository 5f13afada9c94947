// The incremental formulation of the paper (theory.md section 1), kept as a baseline: a step's displacement is a
// polynomial of order n in the coordinates x at the start of the step,
//
//   u(x) = sum_a phi_a(x) D_a,   phi orthonormal on the block as bounded by its present flat sub-faces
//   sigma(x) = sum_b phi_b(x) s_b + Hooke(u)                   stress coefficients s, (p, 6)
//   E = 1/2 integral of sigma : inverse(C) sigma dV = 1/2 sum_b sigma_b : inverse(C) sigma_b
//   dE/dD_aj = sum_i,b (D_i)_ab sigma_b,ij                      D_i the derivative matrices of the basis
//
// At the end of a step the vertices of the sub-faces, and other requested points, move by u. Volume, basis, supports
// and loads are recomputed on the moved sub-faces. Stress and velocity keep their polynomials about the centroid:
// f(x) becomes f(x - s) with s the centroid's motion, but 0 along components held by a support, so that functions
// vanishing on the support still do. Stress is neither rotated nor mapped otherwise. Density is constant, so that the
// mass follows the volume. Volume grows by the factor 1 + t^2 in a step that rotates the block by t, and stress is
// not objective. These are errors of the formulation, not of this program. Energies jump with them, which appears as
// residual in the ledger.
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

/// State of an incremental block at the start of a step, without its velocity.
struct CarriedShape {
  std::vector<Vector3> points;    ///< of the sub-faces, current coordinates, m
  std::vector<Vector3> followed;  ///< other points, m
  Eigen::MatrixXd stress;         ///< s, (p, 6): xx, yy, zz, xy, yz, xz; Pa m^3/2
};

/// Constant data of an incremental block. Constant after construction.
class IncrementalForm {
 public:
  /// Divides the faces of a block of order >= 2.
  /// @throws std::invalid_argument for St.-Venant-Kirchhoff elasticity, which has no incremental form, or a
  /// plane without a face
  explicit IncrementalForm(const BlockDefinition& definition);

  /// Undeformed, without stress.
  [[nodiscard]] CarriedShape start() const;
  /// The block in its present shape: supports and loads of planes on the faces that were in them at first, those at
  /// points at the present places of the points. @throws std::invalid_argument if the block is inverted
  [[nodiscard]] BlockDefinition definition_at(const CarriedShape& shape) const;

  /// Whole or divided faces with the points of the undeformed block; point k is CarriedShape::points[k].
  [[nodiscard]] const SubFaceSurface& surface() const { return surface_; }
  /// Present place of a material point. @param reference one of the sub-faces' points or of the followed ones, bit
  /// for bit. @throws std::invalid_argument for others: their motion is unknown
  [[nodiscard]] const Vector3& place(const CarriedShape& shape, const Vector3& reference) const;

 private:
  BlockDefinition definition_;  ///< undeformed; planes as lists of faces
  SubFaceSurface surface_;
  std::vector<Vector3> followed_;               ///< undeformed: requested points, those of supports and of
                                                ///< loads
  std::map<std::array<double, 3>, int> index_;  ///< of points, then of followed ones, by coordinates
};

/// Stress increment due to a change D of the coefficients. @param change (p, 3). @return (p, 6), as
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

/// T with  sum_b psi_b(x) (T c)_b = sum_a phi_a(x - shift) c_a  for all c: translated polynomials in the basis of the
/// moved block. @param from phi, @param to psi, of the same order. @return (p, p)
[[nodiscard]] Eigen::MatrixXd re_expansion(const PolynomialBasis& from, const PolynomialBasis& to,
                                           const Vector3& shift);

}  // namespace ashlar

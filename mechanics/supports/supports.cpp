#include "mechanics/supports/supports.hpp"

#include <cmath>
#include <stdexcept>

namespace ashlar {
namespace {

/// Conditions of all supports on one component. @return (#conditions, p)
Eigen::MatrixXd conditions(const Polyhedron& solid, const PolynomialBasis& basis,
                           const std::vector<BlockSupport>& supports, std::size_t axis) {
  Eigen::MatrixXd all(0, basis.size());
  for (const BlockSupport& support : supports) {
    const Eigen::MatrixXd rows = support_conditions(solid, basis, support, axis);
    all.conservativeResize(all.rows() + rows.rows(), Eigen::NoChange);
    all.bottomRows(rows.rows()) = rows;
  }
  return all;
}

/// Orthonormal basis of the null space of the conditions. @return (p, p - rank)
Eigen::MatrixXd null_space(const Eigen::MatrixXd& conditions, Eigen::Index functions) {
  if (conditions.rows() == 0) return Eigen::MatrixXd::Identity(functions, functions);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(conditions.transpose());
  qr.setThreshold(support_rank_tolerance);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(functions, functions);
  return q.rightCols(functions - qr.rank());
}

}  // namespace

Eigen::MatrixXd support_conditions(const Polyhedron& solid, const PolynomialBasis& basis,
                                   const BlockSupport& support, std::size_t axis) {
  if (!support.components[axis]) return Eigen::MatrixXd(0, basis.size());
  if (const auto* point = std::get_if<Vector3>(&support.where))
    return basis.values(*point).transpose() * std::sqrt(basis.volume());
  const auto faces = faces_at(solid, support.where);
  if (faces.empty()) throw std::invalid_argument("no face of the block lies in the support's plane");
  // A polynomial of order n that vanishes at the points of a rule of degree 2n vanishes on the face.
  return basis.values(surface_rule(solid, faces, 2 * basis.order()).points) * std::sqrt(basis.volume());
}

AdmissibleSpace::AdmissibleSpace(const Polyhedron& solid, const PolynomialBasis& basis,
                                 const std::vector<BlockSupport>& supports)
    : functions_(basis.size()), free_(supports.empty()) {
  if (free_) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    null_space_[axis] = null_space(conditions(solid, basis, supports, axis), functions_);
  }
  // Admissible rigid motions (of three translations and three rotations of unit norm) have no component orthogonal to
  // the admissible space.
  const Eigen::MatrixXd motions = basis.rigid_motions(1.0).colwise().normalized();
  Eigen::MatrixXd outside(3 * functions_, 6);
  for (int mode = 0; mode < 6; ++mode) {
    const Eigen::MatrixX3d motion = motions.col(mode).reshaped(functions_, 3);
    outside.col(mode) = (motion - expand(restrict(motion))).reshaped();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(outside, Eigen::ComputeThinU | Eigen::ComputeFullV);
  can_turn_ = false;
  held_ = true;
  for (int k = 0; k < 6; ++k) {
    const bool admissible = svd.singularValues()[k] < std::sqrt(support_rank_tolerance);
    if (admissible) held_ = false;
    if (admissible && svd.matrixV().col(k).tail(3).norm() > std::sqrt(support_rank_tolerance))
      can_turn_ = true;
  }
}

int AdmissibleSpace::unknowns() const {
  return static_cast<int>(columns(0) + columns(1) + columns(2));
}

Eigen::MatrixX3d AdmissibleSpace::expand(const Eigen::VectorXd& y) const {
  if (free_) return Eigen::Map<const Eigen::MatrixX3d>(y.data(), functions_, 3);
  Eigen::MatrixX3d q(functions_, 3);
  Eigen::Index start = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    q.col(static_cast<Eigen::Index>(axis)).noalias() = null_space_[axis] * y.segment(start, columns(axis));
    start += columns(axis);
  }
  return q;
}

Eigen::VectorXd AdmissibleSpace::restrict(const Eigen::MatrixX3d& f) const {
  if (free_) return Eigen::Map<const Eigen::VectorXd>(f.data(), f.size());
  Eigen::VectorXd y(unknowns());
  Eigen::Index start = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    y.segment(start, columns(axis)).noalias() =
        null_space_[axis].transpose() * f.col(static_cast<Eigen::Index>(axis));
    start += columns(axis);
  }
  return y;
}

Eigen::MatrixXd AdmissibleSpace::restrict(const Eigen::MatrixXd& matrix) const {
  if (free_) return matrix;
  Eigen::MatrixXd result(unknowns(), unknowns());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    Eigen::Index column = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto block = matrix.block(static_cast<Eigen::Index>(i) * functions_,
                                      static_cast<Eigen::Index>(j) * functions_, functions_, functions_);
      result.block(row, column, columns(i), columns(j)) = null_space_[i].transpose() * block * null_space_[j];
      column += columns(j);
    }
    row += columns(i);
  }
  return result;
}

Eigen::MatrixXd AdmissibleSpace::component_values(const Eigen::MatrixXd& phi, int axis) const {
  if (free_) return phi;
  return phi * null_space_[static_cast<std::size_t>(axis)];
}

}  // namespace ashlar

#include "solver/contact/block_rows.hpp"

#include <algorithm>

namespace ashlar {
namespace {

/// Product with the transpose. For few columns the blocked product spends more time on setup than on work.
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
  constexpr Eigen::Index few = 12;
  if (x.cols() <= few && y.cols() <= few) return x.transpose().lazyProduct(y);
  return x.transpose() * y;
}

/// Functions of a block of order 1, the most frequent one: products of a known size need no buffers.
constexpr int affine = 4;
using AffineValues = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, affine>>;
using AffineUnknowns = Eigen::Matrix<double, affine, 3>;

AffineValues as_affine(const Eigen::MatrixXd& values) {
  return {values.data(), values.rows(), affine};
}

/// Phi' diag(t) Phi of two affine blocks for each t of the stiffnesses, as tangent() of all unknowns. One t after the
/// other: the sums of one fit into registers.
Eigen::MatrixXd affine_tangent(const PointStiffnesses& stiffnesses, const AffineValues& of_a,
                               const AffineValues& of_b) {
  using Square = Eigen::Matrix<double, affine, affine>;
  constexpr Eigen::Index together = 32;  // points whose products stay in the cache
  std::array<Square, together> products;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * affine, 3 * affine);
  for (Eigen::Index first = 0; first < stiffnesses.cols(); first += together) {
    const Eigen::Index count = std::min(together, stiffnesses.cols() - first);
    for (Eigen::Index k = 0; k < count; ++k)
      products[static_cast<std::size_t>(k)] = of_a.row(first + k).transpose() * of_b.row(first + k);
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i <= j; ++i) {
        auto part = result.block<affine, affine>(affine * i, affine * j);
        Square sum = part;
        for (Eigen::Index k = 0; k < count; ++k)
          sum += stiffnesses(3 * j + i, first + k) * products[static_cast<std::size_t>(k)];
        part = sum;
      }
    }
  }
  for (int j = 1; j < 3; ++j)
    for (int i = 0; i < j; ++i)
      result.block<affine, affine>(affine * j, affine * i) =
          result.block<affine, affine>(affine * i, affine * j);
  return result;
}

}  // namespace

BlockRows::BlockRows(const AdmissibleSpace& space, const Eigen::MatrixXd& phi) : same_(space.free()) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    if (!same_ || axis == 0) {
      values_[n] = space.component_values(phi, axis);
      squares_[n] = values_[n].rowwise().squaredNorm();
    }
    starts_[n + 1] = starts_[n] + values(axis).cols();
  }
  if (!same_) supported_ = phi;
}

Eigen::Matrix3Xd BlockRows::displacements(const Eigen::MatrixX3d& change) const {
  if (same_ && fixed()) return Eigen::Matrix3Xd(3, 0);
  return ((same_ ? values_[0] : supported_) * change).transpose();
}

void BlockRows::add_motion(const Eigen::VectorXd& y, double sign, Eigen::Matrix3Xd& motion) const {
  if (fixed()) return;
  if (is_affine()) {
    const AffineUnknowns unknowns = sign * Eigen::Map<const AffineUnknowns>(y.data());
    const AffineValues values = as_affine(values_[0]);
    for (Eigen::Index k = 0; k < motion.cols(); ++k)
      motion.col(k) += unknowns.transpose() * values.row(k).transpose();
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
    motion.row(axis).transpose() += sign * (values(axis) * y.segment(start(axis), count(axis)));
}

void BlockRows::add_force(const Eigen::Matrix3Xd& forces, double sign, Eigen::VectorXd& sum) const {
  if (is_affine()) {
    AffineUnknowns all = AffineUnknowns::Zero();
    for (Eigen::Index k = 0; k < forces.cols(); ++k)
      all += as_affine(values_[0]).row(k).transpose() * forces.col(k).transpose();
    Eigen::Map<AffineUnknowns>(sum.data()) += sign * all;
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
    sum.segment(start(axis), count(axis)).noalias() +=
        sign * (values(axis).transpose() * forces.row(axis).transpose());
}

Eigen::MatrixXd BlockRows::tangent(const PointStiffnesses& stiffnesses, const BlockRows& other) const {
  if (stiffnesses.cols() == 0) return Eigen::MatrixXd::Zero(unknowns(), other.unknowns());
  if (is_affine() && other.is_affine())
    return affine_tangent(stiffnesses, as_affine(values_[0]), as_affine(other.values_[0]));
  Eigen::MatrixXd result(unknowns(), other.unknowns());
  const bool itself = this == &other;
  // t is symmetric.
  const bool mirrored = itself || (same_ && other.same_);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i <= (mirrored ? j : 2); ++i) {
      const Eigen::MatrixXd scaled = stiffnesses.row(3 * j + i).transpose().asDiagonal() * other.values(j);
      result.block(start(i), other.start(j), count(i), other.count(j)) =
          transposed_product(values(i), scaled);
    }
  }
  for (int j = 0; mirrored && j < 3; ++j) {
    for (int i = j + 1; i < 3; ++i) {
      const auto known = result.block(start(j), other.start(i), count(j), other.count(i));
      auto part = result.block(start(i), other.start(j), count(i), other.count(j));
      if (itself)
        part = known.transpose();
      else
        part = known;
    }
  }
  return result;
}

BlockRows BlockRows::at_points(const std::vector<Eigen::Index>& points) const {
  BlockRows result;
  result.same_ = same_;
  result.starts_ = starts_;
  for (std::size_t n = 0; n < (same_ ? 1 : 3); ++n) {
    result.values_[n] = values_[n](points, Eigen::all);
    result.squares_[n] = squares_[n](points);
  }
  return result;
}

double BlockRows::squared_row(Eigen::Index point, const Eigen::Vector3d& direction) const {
  if (fixed()) return 0.0;
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    sum += direction[axis] * direction[axis] * squares_[static_cast<std::size_t>(same_ ? 0 : axis)][point];
  return sum;
}

}  // namespace ashlar

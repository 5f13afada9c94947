#include "solver/step/impact/impact_bodies.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Unknowns up to which a dense factor is faster than a sparse one.
constexpr Eigen::Index most_dense = 90;

}  // namespace

LawfulImpulse lawful_impulse(const ImpactPoint& point, const Vector3d& impulse) {
  LawfulImpulse lawful;
  const double normal = impulse[0], shear = impulse.tail<2>().norm(), friction = point.friction;
  if (point.bonded || (normal >= 0.0 && shear <= friction * normal)) {
    lawful.value = impulse;
    lawful.slope.setIdentity();
    return lawful;
  }
  if (friction * shear <= -normal) return lawful;
  const double share = 1.0 / (1.0 + friction * friction);
  const double on_cone = share * (normal + friction * shear);
  lawful.value[0] = on_cone;
  lawful.slope(0, 0) = share;
  if (shear == 0.0) return lawful;
  const Vector2d along = impulse.tail<2>() / shear;
  lawful.value.tail<2>() = friction * on_cone * along;
  lawful.slope.block<2, 1>(1, 0) = friction * share * along;
  lawful.slope.block<1, 2>(0, 1) = friction * share * along.transpose();
  lawful.slope.block<2, 2>(1, 1) =
      friction * friction * share * along * along.transpose() +
      friction * on_cone / shear * (Eigen::Matrix2d::Identity() - along * along.transpose());
  return lawful;
}

ImpactFactor::ImpactFactor(const MatrixXd& matrix) : dense_(matrix) {}

ImpactFactor::ImpactFactor(const Eigen::SparseMatrix<double>& matrix)
    : sparse_(std::make_shared<const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>>(matrix)) {}

VectorXd ImpactFactor::solve(const VectorXd& b) const {
  if (sparse_ != nullptr) return sparse_->solve(b);
  return dense_.solve(b);
}

ImpactBodies::ImpactBodies(const std::vector<double>& inertia, const std::vector<int>& sizes,
                           const std::vector<ImpactPoint>& points)
    : points_(points), begin_(1, 0) {
  for (const int size : sizes) begin_.push_back(begin_.back() + size);
  inertia_.resize(begin_.back());
  for (std::size_t b = 0; b < sizes.size(); ++b)
    inertia_.segment(begin_[b], sizes[b]).setConstant(inertia[b]);
  for (const ImpactPoint& point : points) {
    double mobility = 0.0;
    for_sides(point, [&](int body, const Matrix3Xd& rows) {
      mobility += rows.squaredNorm() / (3.0 * inertia[at(body)]);
    });
    mobilities_.push_back(mobility);
    fastest_ = std::max(fastest_, point.velocity.norm());
    if (mobility > 0.0) speed_ = std::max(speed_, point.velocity.norm() / std::sqrt(mobility));
  }
}

Vector3d ImpactBodies::motion(std::size_t k, const VectorXd& z) const {
  Vector3d sum = Vector3d::Zero();
  for_sides(points_[k], [&](int body, const Matrix3Xd& rows) {
    sum.noalias() += rows * z.segment(begin_[at(body)], rows.cols());
  });
  return sum;
}

Vector3d ImpactBodies::given(std::size_t k) const {
  const ImpactPoint& point = points_[k];
  return point.bonded ? Vector3d(Vector3d::Zero())
                      : Vector3d(point.velocity - point.target * Vector3d::UnitX());
}

VectorXd ImpactBodies::on_bodies(const std::vector<Vector3d>& impulses) const {
  VectorXd sum = VectorXd::Zero(unknowns());
  for (std::size_t k = 0; k < points_.size(); ++k)
    for_sides(points_[k], [&](int body, const Matrix3Xd& rows) {
      sum.segment(begin_[at(body)], rows.cols()).noalias() += rows.transpose() * impulses[k];
    });
  return sum;
}

template <class Add>
void ImpactBodies::each_part(const std::vector<Matrix3d>& stiffness, const Add& add) const {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (stiffness[k].isZero(0.0)) continue;
    for_sides(points_[k], [&](int row_body, const Matrix3Xd& row) {
      const Eigen::MatrixX3d left = row.transpose() * stiffness[k];
      for_sides(points_[k],
                [&](int column_body, const Matrix3Xd& column) { add(row_body, column_body, left * column); });
    });
  }
}

bool ImpactBodies::is_small() const {
  return unknowns() <= most_dense;
}

MatrixXd ImpactBodies::dense(const std::vector<Matrix3d>& stiffness) const {
  MatrixXd matrix = inertia_.asDiagonal();
  each_part(stiffness, [&](int row, int column, const auto& part) {
    matrix.block(begin_[at(row)], begin_[at(column)], part.rows(), part.cols()).noalias() += part;
  });
  return matrix;
}

Eigen::SparseMatrix<double> ImpactBodies::sparse(const std::vector<Matrix3d>& stiffness) const {
  std::map<std::pair<int, int>, MatrixXd> blocks;  // by bodies
  for (std::size_t body = 0; body + 1 < begin_.size(); ++body) {
    const int index = static_cast<int>(body);
    blocks[{index, index}] = of_body(body, inertia_).asDiagonal();
  }
  each_part(stiffness, [&](int row, int column, const auto& part) {
    MatrixXd& block = blocks[{row, column}];
    if (block.size() == 0) block.setZero(part.rows(), part.cols());
    block.noalias() += part;
  });
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [bodies, block] : blocks)
    for (Eigen::Index j = 0; j < block.cols(); ++j)
      for (Eigen::Index i = 0; i < block.rows(); ++i)
        entries.emplace_back(begin_[at(bodies.first)] + i, begin_[at(bodies.second)] + j, block(i, j));
  Eigen::SparseMatrix<double> matrix(unknowns(), unknowns());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

VectorXd ImpactBodies::solve(const std::vector<Matrix3d>& stiffness, const VectorXd& b) const {
  if (is_small()) return dense(stiffness).partialPivLu().solve(b);
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(sparse(stiffness));
  return factor.solve(b);
}

ImpactFactor ImpactBodies::factor(const std::vector<Matrix3d>& stiffness) const {
  return is_small() ? ImpactFactor(dense(stiffness)) : ImpactFactor(sparse(stiffness));
}

double ImpactBodies::residual(const std::vector<Vector3d>& impulses) const {
  if (fastest_ == 0.0) return 0.0;
  const VectorXd z = changes(impulses);
  double largest = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (mobilities_[k] == 0.0) continue;
    Vector3d velocity = after(k, z);
    if (!points_[k].bonded) velocity[0] += points_[k].friction * velocity.tail<2>().norm();
    const Vector3d lawful = lawful_impulse(points_[k], impulses[k] - velocity / mobilities_[k]).value;
    largest = std::max(largest, mobilities_[k] * (impulses[k] - lawful).norm());
  }
  return largest / fastest_;
}

double ImpactBodies::work(const std::vector<Vector3d>& impulses) const {
  const VectorXd z = changes(impulses);
  double sum = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k)
    sum += impulses[k].dot(points_[k].velocity + 0.5 * motion(k, z));
  return sum;
}

void FoundImpulses::take(const ImpactBodies& bodies, const std::vector<Vector3d>& others) {
  const double of_others = bodies.residual(others);
  if (!(of_others < residual)) return;
  residual = of_others;
  impulses = others;
}

}  // namespace ashlar

#include "mechanics/block/rigid_body.hpp"

#include "mechanics/basis/field_moments.hpp"

namespace ashlar {
namespace {

/// Positions relative to the centroid.
Eigen::MatrixX3d without_mean(Eigen::MatrixX3d field) {
  field.row(0).setZero();
  return field;
}

}  // namespace

Eigen::MatrixXd rigid_fields(const Eigen::MatrixX3d& position) {
  const Eigen::Index functions = position.rows();
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(3 * functions, rigid_freedom);
  const Eigen::MatrixX3d arms = without_mean(position);
  Eigen::MatrixXd turns(3 * functions, 3);
  for (int axis = 0; axis < 3; ++axis) {
    fields(axis * functions, axis) = 1.0;
    turns.col(axis) = turning_field(Eigen::Vector3d::Unit(axis), arms).reshaped();
  }
  const Eigen::LLT<Eigen::Matrix3d> root(unit_inertia(arms));
  fields.rightCols<3>() = root.matrixU().solve<Eigen::OnTheRight>(turns);
  return fields;
}

Eigen::VectorXd constant_function(Eigen::Index size, double volume) {
  Eigen::VectorXd one = Eigen::VectorXd::Zero(size);
  one[0] = std::sqrt(volume);
  return one;
}

Eigen::MatrixX3d rigid_velocity(const Eigen::MatrixX3d& position, double volume, const Eigen::Vector3d& about,
                                const Eigen::Vector3d& translation, const Eigen::Vector3d& rotation) {
  const Eigen::VectorXd one = constant_function(position.rows(), volume);
  const Eigen::MatrixX3d arm = position - one * about.transpose();
  return one * translation.transpose() + arm.rowwise().cross(-rotation.transpose());
}

Eigen::MatrixX3d rigid_change(const Eigen::MatrixX3d& position, const Eigen::MatrixX3d& change) {
  const Eigen::MatrixX3d middle = without_mean(position + 0.5 * change);
  const Eigen::Vector3d spin =
      unit_inertia(middle).llt().solve(integral_of_cross(middle, without_mean(change)));
  Eigen::Matrix3d half;  // 1/2 s x
  for (int axis = 0; axis < 3; ++axis) half.col(axis) = 0.5 * spin.cross(Eigen::Vector3d::Unit(axis));
  // D = S (A + D / 2) for each coefficient.
  const Eigen::Matrix3d turn = (Eigen::Matrix3d::Identity() - half).inverse() * 2.0 * half;
  Eigen::MatrixX3d result = without_mean(position) * turn.transpose();
  result.row(0) = change.row(0);
  return result;
}

}  // namespace ashlar

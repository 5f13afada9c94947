#include "mechanics/basis/field_moments.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace ashlar {

Vector3 mean_of(const FieldCoefficients& field, double volume) {
  return field.row(0) / std::sqrt(volume);
}

Eigen::MatrixX3d from_point(const FieldCoefficients& position, double volume, const Vector3& point) {
  Eigen::MatrixX3d result = position;
  result.row(0) -= std::sqrt(volume) * point.transpose();
  return result;
}

Vector3 integral_of_cross(const FieldCoefficients& a, const FieldCoefficients& b) {
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index k = 0; k < a.rows(); ++k) sum += Vector3(a.row(k)).cross(Vector3(b.row(k)));
  return sum;
}

Eigen::Matrix3d unit_inertia(const FieldCoefficients& position) {
  const Eigen::Matrix3d products = position.transpose() * position;
  return products.trace() * Eigen::Matrix3d::Identity() - products;
}

Eigen::MatrixX3d turning_field(const Vector3& w, const FieldCoefficients& field) {
  Eigen::MatrixX3d result(field.rows(), 3);
  for (Eigen::Index k = 0; k < field.rows(); ++k) result.row(k) = w.cross(Vector3(field.row(k)));
  return result;
}

}  // namespace ashlar

#include "mechanics/block/material_map.hpp"

#include <cmath>

#include "mechanics/block/block_parts.hpp"

namespace ashlar {
namespace {

/// Newton's method for the material point at a place: steps, and the length of the last one in sizes of the block. The error
/// after a step is of the order of its square: after one of 1e-8 it is within rounding error.
constexpr int most_place_steps = 12;
constexpr double last_place_step = 1e-8;

}  // namespace

MaterialMap::MaterialMap(const BlockModel& model, const BlockState& state)
    : model_(&model),
      state_(&state),
      affine_(model.fixed() || model.order() == 1),
      size_(model.size()),
      centroid_(model.basis().centroid()),
      middle_(state.position.transpose() * model.basis().values(centroid_)),
      gradient_(gradient(centroid_)),
      inverse_(Eigen::Matrix3d::Identity()) {
  const double determinant = gradient_.determinant();
  invertible_ = std::isfinite(determinant) && determinant > 0.0;
  if (invertible_) inverse_ = gradient_.inverse();
}

Eigen::Matrix3d MaterialMap::gradient(const Vector3& material) const {
  return state_->position.transpose() * model_->basis().gradients(material);
}

std::optional<Vector3> MaterialMap::material(const Vector3& place) const {
  if (!invertible_) return std::nullopt;
  Vector3 point = centroid_ + inverse_ * (place - middle_);
  if (affine_) return point;
  // A step longer than the block leaves its surroundings.
  for (int step = 0; step < most_place_steps; ++step) {
    const Vector3 residual = place - state_->position.transpose() * model_->basis().values(point);
    const Vector3 change = gradient(point).partialPivLu().solve(residual);
    if (!change.allFinite() || change.norm() > size_) return std::nullopt;
    point += change;
    if (change.norm() <= last_place_step * size_) return point;
  }
  return std::nullopt;
}

double MaterialMap::stretch_across(const Vector3& material, const Vector3& normal) const {
  const Eigen::Matrix3d deformation = affine_ ? gradient_ : gradient(material);
  return 1.0 / deformation.transpose().partialPivLu().solve(normal).norm();
}

Vector3 MaterialMap::placed_normal(const Vector3& material, const Vector3& normal) const {
  const Eigen::Matrix3d deformation = affine_ ? gradient_ : gradient(material);
  return deformation.transpose().partialPivLu().solve(normal).normalized();
}

}  // namespace ashlar

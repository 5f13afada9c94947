// Which material point of a block is at a place: the inverse of its motion x = phi(X).
//
// Affine blocks are inverted once. For higher orders Newton's method goes on from the affine mean of the
// motion: what is inside or near the block is found in two to four steps, what is far from it, where the
// polynomial means nothing, is given up.
#pragma once

#include <optional>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// The inverse of a block's motion in one state.
class MaterialMap {
 public:
  /// @param model,state must outlive this
  MaterialMap(const BlockModel& model, const BlockState& state);

  /// @param place current coordinates, m. @return coordinates of the model's solid, m; none: no material
  /// point of the block or its near surroundings, or the mean deformation cannot be inverted
  [[nodiscard]] std::optional<Vector3> material(const Vector3& place) const;
  /// Current thickness over reference thickness of a layer at a material point.
  /// @param normal of the layer, unit, reference coordinates
  [[nodiscard]] double stretch_across(const Vector3& material, const Vector3& normal) const;
  /// The current normal of such a layer, unit.
  [[nodiscard]] Vector3 placed_normal(const Vector3& material, const Vector3& normal) const;

 private:
  [[nodiscard]] Eigen::Matrix3d gradient(const Vector3& material) const;

  const BlockModel* model_;
  const BlockState* state_;
  bool affine_;
  bool invertible_ = true;
  double size_;               ///< m
  Vector3 centroid_;          ///< material
  Vector3 middle_;            ///< where it is, m
  Eigen::Matrix3d gradient_;  ///< at the centroid
  Eigen::Matrix3d inverse_;
};

}  // namespace ashlar

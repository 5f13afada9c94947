// Material point of a block at a given place: the inverse of its motion x = phi(X).
//
// Affine blocks are inverted once. For higher orders Newton's method starts from the affine mean of the motion.
// Points inside or near the block are found in two to four steps. Points far from it, where the polynomial has no
// meaning, are given up.
#pragma once

#include <optional>

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// The inverse of a block's motion in one state.
class MaterialMap {
 public:
  /// @param model,state must outlive this
  MaterialMap(const BlockModel& model, const BlockState& state);

  /// @param place current coordinates, m. @return coordinates of the model's solid, m; empty if there is no material
  /// point in the block or its near surroundings, or the mean deformation is singular
  [[nodiscard]] std::optional<Vector3> material(const Vector3& place) const;
  /// Current thickness over reference thickness of a layer at a material point.
  /// @param normal of the layer, unit, reference coordinates
  [[nodiscard]] double stretch_across(const Vector3& material, const Vector3& normal) const;
  /// Current unit normal of such a layer.
  [[nodiscard]] Vector3 placed_normal(const Vector3& material, const Vector3& normal) const;

 private:
  [[nodiscard]] Eigen::Matrix3d gradient(const Vector3& material) const;

  const BlockModel* model_;
  const BlockState* state_;
  bool affine_;
  bool invertible_ = true;
  double size_;               ///< m
  Vector3 centroid_;          ///< material
  Vector3 middle_;            ///< current place of the centroid, m
  Eigen::Matrix3d gradient_;  ///< at the centroid
  Eigen::Matrix3d inverse_;
};

}  // namespace ashlar

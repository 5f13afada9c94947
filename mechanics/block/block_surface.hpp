// The surface of a block as its motion places it: whole faces of a block that stays affine, adaptive
// sub-faces of one that curves, the fixed division of an incremental one.
#pragma once

#include <memory>
#include <optional>

#include "geometry/subfaces/placed_surface.hpp"
#include "geometry/subfaces/sub_face_refinement.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Keeps its division from step to step.
class BlockSurface {
 public:
  /// @param model must outlive this. @param levels uniform levels (0 to 8) that divisions of curved faces
  /// start from. @param axes see AdaptiveSurface. @param twin of a block with the same parts and solid but
  /// for a translation, to share what does not change; null: none
  BlockSurface(const BlockModel& model, int levels, const Eigen::Matrix3d& axes,
               const BlockSurface* twin = nullptr);

  /// Takes over the coordinates of a new step of an incremental block.
  void start_step();
  /// Takes the block's present shape.
  void move(const BlockState& state);
  /// Contains the true surface as moved last; along the axes.
  [[nodiscard]] const Box& box() const { return box_; }
  /// How far any surface point can have gone between two states, m, from above.
  [[nodiscard]] double motion_bound(const BlockState& before, const BlockState& after) const;

  /// The same, looser, but at the cost of a sum over the coefficients. @param change of them, (p, 3)
  [[nodiscard]] double quick_motion_bound(const Eigen::MatrixX3d& change) const;
  /// Largest speed of the surface's points, m/s.
  [[nodiscard]] double largest_speed(const BlockState& state) const;

  /// Whether its faces may curve, so that they are divided.
  [[nodiscard]] bool curves() const { return adaptive_.has_value(); }
  /// Divides and joins the faces of a block that curves. @return true if cells changed
  bool divide(const DivisionDemand& demand);
  [[nodiscard]] const SubFaceSurface& surface() const;
  /// The surface as moved and divided last. The BlockSurface must outlive it and stay unchanged.
  [[nodiscard]] PlacedSurface placed() const;
  /// How far the true surface may be from its present cells in a state, m; 0 if cells are all there is.
  [[nodiscard]] double bulge(const BlockState& state) const;
  /// Current positions of the surface's points in a state, m.
  [[nodiscard]] std::vector<Vector3> points(const BlockState& state) const;
  /// Current positions of the middles of the surface's edges (SubFaceSurface::edges) if they may curve, m.
  /// @return (#edges); empty: edges stay straight
  [[nodiscard]] std::vector<Vector3> edge_middles(const BlockState& state) const;

  /// See AdaptiveSurface::wanted; empty for blocks that stay affine.
  [[nodiscard]] std::vector<std::uint64_t> wanted() const;
  /// How it is divided now; nothing of blocks that stay affine. To be given to the surface of an equal block, before
  /// move(). @throws std::invalid_argument if it is of another surface
  [[nodiscard]] SurfaceDivision division() const;
  void restore(const SurfaceDivision& division);

 private:
  [[nodiscard]] Eigen::Matrix3Xd domain_values(const BlockState& state) const;
  void take_division();

  const BlockModel* model_;
  Eigen::Matrix3d axes_;
  std::optional<AdaptiveSurface> adaptive_;
  SubFaceSurface whole_;  ///< of a block that stays affine or is incremental
  /// phi at the domain points of a block that curves
  std::shared_ptr<const Eigen::MatrixXd> domain_phi_;
  Eigen::MatrixXd point_phi_;       ///< phi at the surface's points
  Eigen::MatrixXd middle_phi_;      ///< phi at the middles of the edges of a block that curves
  Eigen::RowVectorXd largest_phi_;  ///< (p) no larger in magnitude is each function anywhere on the surface
  BlockState state_;                ///< as moved last
  std::vector<Vector3> points_;     ///< in that state
  Box box_;
};

}  // namespace ashlar

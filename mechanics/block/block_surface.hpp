// The surface of a moving block: whole faces of an affine block, adaptive sub-faces of a curved one, the fixed
// division of an incremental one.
#pragma once

#include <memory>
#include <optional>

#include "geometry/subfaces/placed_surface.hpp"
#include "geometry/subfaces/sub_face_refinement.hpp"
#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Keeps its division between steps.
class BlockSurface {
 public:
  /// @param model must outlive this. @param levels initial uniform levels (0 to 8) of the division of curved faces.
  /// @param axes see AdaptiveSurface. @param twin of a block with the same parts and a translated solid, to share
  /// constant data; null: none
  BlockSurface(const BlockModel& model, int levels, const Eigen::Matrix3d& axes,
               const BlockSurface* twin = nullptr);

  /// Updates the coordinates for a new step of an incremental block.
  void start_step();
  /// Updates the surface to the block's present shape.
  void move(const BlockState& state);
  /// Box along the axes that contains the true surface after the last move().
  [[nodiscard]] const Box& box() const { return box_; }
  /// Upper bound of the displacement of any surface point between two states, m.
  [[nodiscard]] double motion_bound(const BlockState& before, const BlockState& after) const;

  /// The same, less tight, at the cost of a sum over the coefficients. @param change of them, (p, 3)
  [[nodiscard]] double quick_motion_bound(const Eigen::MatrixX3d& change) const;
  /// Largest speed of the surface's points, m/s.
  [[nodiscard]] double largest_speed(const BlockState& state) const;

  /// True if its faces may curve and are therefore divided.
  [[nodiscard]] bool curves() const { return adaptive_.has_value(); }
  /// Divides and merges the faces of a curved block. @return true if cells changed
  bool divide(const DivisionDemand& demand);
  [[nodiscard]] const SubFaceSurface& surface() const;
  /// The surface after the last move() and divide(). The BlockSurface must outlive it and stay unchanged.
  [[nodiscard]] PlacedSurface placed() const;
  /// Upper bound of the distance of the true surface from its present cells in a state, m; 0 if it consists of cells.
  [[nodiscard]] double bulge(const BlockState& state) const;
  /// Current positions of the surface's points in a state, m.
  [[nodiscard]] std::vector<Vector3> points(const BlockState& state) const;
  /// Current positions of the midpoints of the surface's edges (SubFaceSurface::edges) if these may curve, m.
  /// @return (#edges); empty: edges stay straight
  [[nodiscard]] std::vector<Vector3> edge_middles(const BlockState& state) const;

  /// See AdaptiveSurface::wanted; empty for affine blocks.
  [[nodiscard]] std::vector<std::uint64_t> wanted() const;
  /// Present division; empty for affine blocks.
  [[nodiscard]] SurfaceDivision division() const;
  /// Takes over the division of the surface of an equal block. As a new one, it has no shape until move().
  /// @throws std::invalid_argument if it belongs to another surface
  void restore(const SurfaceDivision& division);

 private:
  [[nodiscard]] Eigen::Matrix3Xd domain_values(const BlockState& state) const;
  void take_division();

  const BlockModel* model_;
  Eigen::Matrix3d axes_;
  std::optional<AdaptiveSurface> adaptive_;
  SubFaceSurface whole_;  ///< of an affine or incremental block
  /// phi at the domain points of a curved block
  std::shared_ptr<const Eigen::MatrixXd> domain_phi_;
  Eigen::MatrixXd point_phi_;       ///< phi at the surface's points
  Eigen::MatrixXd middle_phi_;      ///< phi at the midpoints of the edges of a curved block
  Eigen::RowVectorXd largest_phi_;  ///< (p) upper bound of the magnitude of each function on the surface
  BlockState state_;                ///< at the last move()
  std::vector<Vector3> points_;     ///< in that state
  Box box_;
};

}  // namespace ashlar

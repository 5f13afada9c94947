#include "apps/results/frames/block_frames.hpp"

#include <Eigen/Eigenvalues>
#include <cstdint>
#include <utility>

#include "apps/results/tables/append_vector.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Data common to cells of all kinds; `Drawn` is DrawnSurface or DrawnSolid.
template <class Drawn>
class FrameOfBlocks {
 public:
  FrameOfBlocks(const SceneOutput::Fields& fields, const std::vector<std::vector<Vector3>>& origin)
      : fields_(fields), origin_(origin) {}

  /// @return the number of the block's first point
  int add_points(int b, const BlockModel& block, const BlockState& state, const Drawn& drawn) {
    const int first = static_cast<int>(grid_.points.size());
    const std::vector<PointMotion> motions = block.motions_of(state, drawn.points);
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const PointMotion& motion = motions[k];
      grid_.points.push_back(motion.place);
      append(displacement_,
             origin_.empty() ? motion.displacement : Vector3(motion.displacement - origin_[at(b)][k]));
      append(velocity_, motion.velocity);
      const Eigen::Matrix3d& s = motion.stress;
      if (fields_.stress)
        stress_.insert(stress_.end(), {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)});
      if (!fields_.principal_stress) continue;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(s, Eigen::EigenvaluesOnly);
      append(principal_, principal.eigenvalues().reverse());
    }
    return first;
  }

  void add_cell(int b, const BlockModel& block, VtkCellType type, int first, const std::vector<int>& cell) {
    std::vector<int> points;
    points.reserve(cell.size());
    for (const int point : cell) points.push_back(first + point);
    grid_.add_cell(type, points);
    block_.push_back(b);
    order_.push_back(block.fixed() || block.rigid() ? 0 : block.order());
    fixed_.push_back(block.fixed() ? 1 : 0);
  }

  UnstructuredGrid take() {
    if (fields_.displacement)
      grid_.point_data.push_back({"displacement", 3, {"x", "y", "z"}, std::move(displacement_)});
    if (fields_.velocity) grid_.point_data.push_back({"velocity", 3, {"x", "y", "z"}, std::move(velocity_)});
    if (fields_.stress)
      grid_.point_data.push_back({"stress", 6, {"xx", "yy", "zz", "xy", "yz", "xz"}, std::move(stress_)});
    if (fields_.principal_stress)
      grid_.point_data.push_back(
          {"principal_stress", 3, {"largest", "middle", "least"}, std::move(principal_)});
    grid_.cell_data.push_back({"block", 1, {}, std::move(block_)});
    grid_.cell_data.push_back({"order", 1, {}, std::move(order_)});
    grid_.cell_data.push_back({"fixed", 1, {}, std::move(fixed_)});
    return std::move(grid_);
  }

 private:
  const SceneOutput::Fields& fields_;
  const std::vector<std::vector<Vector3>>& origin_;
  UnstructuredGrid grid_;
  std::vector<double> displacement_, velocity_, stress_, principal_;
  std::vector<std::int32_t> block_, order_, fixed_;  ///< by cell
};

}  // namespace

DrawnBlocks drawn_blocks(const std::vector<BlockModel>& blocks, const SceneOutput& output) {
  DrawnBlocks drawn{drawn_surfaces(blocks, output.curved), {}};
  if (output.solid) drawn.solids = drawn_solids(blocks, output.curved);
  return drawn;
}

UnstructuredGrid block_frame(const std::vector<BlockModel>& blocks, const std::vector<BlockState>& states,
                             const std::vector<DrawnSurface>& surfaces, const SceneOutput::Fields& fields,
                             const std::vector<bool>& absent, const DisplacementOrigin& origin) {
  FrameOfBlocks<DrawnSurface> frame(fields, origin.surfaces);
  std::vector<std::int32_t> face;
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b) {
    if (!absent.empty() && absent[at(b)]) continue;
    const int first = frame.add_points(b, blocks[at(b)], states[at(b)], surfaces[at(b)]);
    for (const DrawnSurface::Cell& cell : surfaces[at(b)].cells) {
      frame.add_cell(b, blocks[at(b)], cell.type, first, cell.points);
      face.push_back(cell.face);
    }
  }
  UnstructuredGrid grid = frame.take();
  grid.cell_data.push_back({"face", 1, {}, std::move(face)});
  return grid;
}

UnstructuredGrid solid_frame(const std::vector<BlockModel>& blocks, const std::vector<BlockState>& states,
                             const std::vector<DrawnSolid>& solids, const SceneOutput::Fields& fields,
                             const std::vector<bool>& absent, const DisplacementOrigin& origin) {
  FrameOfBlocks<DrawnSolid> frame(fields, origin.solids);
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b) {
    if (!absent.empty() && absent[at(b)]) continue;
    const int first = frame.add_points(b, blocks[at(b)], states[at(b)], solids[at(b)]);
    for (const std::vector<int>& cell : solids[at(b)].cells)
      frame.add_cell(b, blocks[at(b)], solids[at(b)].type, first, cell);
  }
  return frame.take();
}

}  // namespace ashlar

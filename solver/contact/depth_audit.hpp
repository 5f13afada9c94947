// How deep blocks are in each other, without asking their contacts: the true depth of the deepest corner,
// sub-face point, middle of a sub-face or edge of any block in another one, over all near pairs.
//
// Points of one block's surface are taken back to the reference shape of the other one (material_map.hpp),
// where faces are flat whatever the block's order is, and asked there how deep they are (solid_depth.hpp).
// The depth is that in the current shape: a layer below a face is thinner where the block is pressed. It is
// exact to rounding for blocks of order 1, and to the change of the deformation within the depth for others.
//
// What has hardly moved is not asked again (notes/lasting_contacts.md): the depth of two blocks that have not is that
// of the same two material points.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "geometry/any_solid/solid_depth.hpp"
#include "geometry/boxes/box.hpp"
#include "mechanics/block/block_surface.hpp"

namespace ashlar {

/// The deepest point of one block in another one.
struct PairDepth {
  std::array<int, 2> blocks;  ///< the block with the point, then the one that it is in
  double depth = 0.0;         ///< m, > 0
  Vector3 place;              ///< current coordinates, m
  int face = -1;              ///< of the second block's solid: the nearest
  Vector3 normal;             ///< of it, outward, current coordinates, unit
  std::array<Vector3, 2>
      materials;  ///< the point, and that of the face nearest to it, reference coordinates, m
};

/// A depth as it was measured, and where its two material points were then.
struct MeasuredDepth {
  PairDepth pair;
  std::array<Vector3, 2> places;  ///< current coordinates, m
};

/// What is known from the audits of the steps before: part of the state of a run. By block.
struct KnownDepths {
  std::vector<Eigen::MatrixX3d>
      positions;           ///< where the block was when all of its neighbours were looked for; empty: never
  std::vector<Box> boxes;  ///< of it there
  std::vector<MeasuredDepth> depths;  ///< of all pairs, in the order of meeting_boxes()
};

/// A ball in the reference shape of a solid that has nothing of the solid in it.
struct ClearBall {
  Vector3 center = Vector3::Zero();
  double radius = -1.0;  ///< m; negative: not known

  /// Radius of the largest ball around another point that it contains, m; negative: none.
  [[nodiscard]] double around(const Vector3& x) const { return radius - (x - center).norm(); }
};

/// A segment in the reference shape of a solid that is clear of the solid.
struct ClearSegment {
  Vector3 start = Vector3::Zero();
  Vector3 end = Vector3::Zero();
  double distance = 0.0;  ///< m, from the solid at least; 0: not known

  /// Whether a segment is so near to it that it is clear too.
  [[nodiscard]] bool clears(const Vector3& from, const Vector3& to) const {
    return std::max((from - start).norm(), (to - end).norm()) < distance;
  }
};

/// What is known of the points and edges of a block near one that is not convex: which need not be asked
/// again.
struct ClearParts {
  std::vector<ClearBall> points;    ///< of the surface, then those of its cells
  std::vector<ClearSegment> edges;  ///< halves of edges that may curve, one after the other
};

/// A block as an audit sees it.
struct AuditedBlock {
  std::vector<Vector3> points;   ///< of its surface, m; empty: not looked at yet
  Box box;                       ///< of the points, grown by how far the surface is off its cells
  std::vector<Vector3> cells;    ///< means of the corners of its sub-faces, m
  std::vector<Vector3> middles;  ///< of its edges, m; empty: they are straight
  std::vector<Box> edges;        ///< empty: no other block has been near
};

/// What an audit looks at.
struct AuditScope {
  std::function<bool(int, int)> pairs;  ///< a < b; whether the two may not be in each other
  std::vector<bool> moving;             ///< by block; depths of two that are held are of no interest
  double resolution = 0.0;  ///< m, > 0: how exact depths of edges are in solids that are not convex
  int threads = 1;
  /// m, >= 0: blocks that have moved less since they were looked at are not asked again
  double unmoved = 0.0;
  bool fine = true;  ///< whether pairs with solids that are not convex are measured in any case
};

/// What an audit has found.
struct Audit {
  std::vector<PairDepth>
      depths;  ///< the deepest point of every ordered pair of blocks that are in each other, by blocks
  /// Blocks that were looked at anew, with where they are; to be taken over into KnownDepths with `measured`
  std::vector<int> moved;
  std::vector<Eigen::MatrixX3d> positions;  ///< of them
  std::vector<Box> boxes;                   ///< of them
  std::vector<MeasuredDepth> measured;      ///< of all pairs, old and new

  /// What the next audit is to know.
  void take_over(KnownDepths& known) const;
};

/// Keeps what does not change of each block from audit to audit; results do not depend on it.
class DepthAudit {
 public:
  explicit DepthAudit(std::size_t blocks) : audited_(blocks), finders_(blocks) {}

  /// @param states finite. @param known empty: nothing
  [[nodiscard]] Audit run(const std::vector<BlockModel>& blocks, const std::vector<BlockState>& states,
                          const std::vector<BlockSurface>& surfaces, const AuditScope& scope,
                          const KnownDepths& known = {});
  /// To be called when the solid of a block has changed.
  void forget(std::size_t block);

 private:
  /// Whether the solid of a block is convex.
  [[nodiscard]] bool is_convex(int block, const std::vector<BlockModel>& blocks);
  /// Makes room for what is known of the points of the first block near the second.
  void prepare(const std::array<int, 2>& blocks, std::size_t points, std::size_t edges);

  /// The deepest points of pairs of placed blocks in each other.
  [[nodiscard]] std::vector<MeasuredDepth> measure(const std::vector<std::array<int, 2>>& pairs,
                                                   const std::vector<BlockModel>& blocks,
                                                   const std::vector<BlockState>& states,
                                                   const std::vector<BlockSurface>& surfaces,
                                                   const AuditScope& scope);

  std::vector<AuditedBlock> audited_;                     ///< those of fixed blocks stay
  std::vector<std::optional<SolidDepthFinder>> finders_;  ///< of blocks that have been near others
  std::map<std::array<int, 2>, ClearParts>
      clear_;  ///< of a block (first) near another one; empty: that is convex
};

}  // namespace ashlar

// How deep blocks are in each other, without asking their contacts: the true depth of the deepest corner,
// sub-face point or edge of any block in another one, over all near pairs.
//
// Points of one block's surface are taken back to the reference shape of the other one (material_map.hpp),
// where faces are flat whatever the block's order is, and asked there how deep they are (solid_depth.hpp).
// The depth is that in the current shape: a layer below a face is thinner where the block is pressed. It is
// exact to rounding for blocks of order 1, and to the change of the deformation within the depth for others.
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
  /// Points of the first block's surface that it is on: one, or both ends of an edge.
  std::array<int, 2> points;
  double along = 0.0;  ///< of the edge, from its first end, 0 to 1
  int face = -1;       ///< of the second block's solid: the nearest
  Vector3 normal;      ///< of it, outward, current coordinates, unit
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
  std::vector<ClearBall> points;
  std::vector<ClearSegment> edges;  ///< halves of edges that may curve, one after the other
};

/// A block as an audit sees it.
struct AuditedBlock {
  std::vector<Vector3> points;   ///< of its surface, m; empty: not looked at yet
  Box box;                       ///< of the points, grown by how far the surface is off its cells
  std::vector<Vector3> middles;  ///< of its edges, m; empty: they are straight
  std::vector<Box> edges;        ///< empty: no other block has been near
};

/// What an audit looks at.
struct AuditScope {
  std::function<bool(int, int)> pairs;  ///< a < b; whether the two may not be in each other
  std::vector<bool> moving;             ///< by block; others are where they were in the last audit
  double resolution = 0.0;  ///< m, > 0: how exact depths of edges are in solids that are not convex
  int threads = 1;
};

/// Keeps what does not change of each block from audit to audit.
class DepthAudit {
 public:
  explicit DepthAudit(std::size_t blocks) : audited_(blocks), finders_(blocks) {}

  /// The deepest point of every ordered pair of blocks that are in each other, by blocks.
  /// @param states finite
  [[nodiscard]] std::vector<PairDepth> run(const std::vector<BlockModel>& blocks,
                                           const std::vector<BlockState>& states,
                                           const std::vector<BlockSurface>& surfaces,
                                           const AuditScope& scope);
  /// To be called when the solid of a block has changed.
  void forget(std::size_t block);

 private:
  /// Makes room for what is known of the points of the first block near the second.
  void prepare(const std::array<int, 2>& blocks, std::size_t points, std::size_t edges);

  std::vector<AuditedBlock> audited_;                     ///< those of fixed blocks stay
  std::vector<std::optional<SolidDepthFinder>> finders_;  ///< of blocks that have been near others
  std::map<std::array<int, 2>, ClearParts>
      clear_;  ///< of a block (first) near another one; empty: that is convex
};

}  // namespace ashlar

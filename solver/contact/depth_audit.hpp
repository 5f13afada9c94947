// Penetration of blocks independent of their contacts: the true depth of the deepest corner, sub-face point, centre
// of a sub-face or edge of any block in another one, over all near pairs.
//
// Points of one block's surface are mapped to the reference shape of the other one (material_map.hpp), where faces
// are flat for any order of the block. Their depth is measured there (solid_depth.hpp) and converted to the current
// shape: a layer below a face is thinner where the block is compressed. It is exact to rounding for blocks of order
// 1, and to the change of the deformation within the depth for others.
//
// Pairs without motion are not measured again (notes/contact_cache.md): their depth is that of the same two
// material points.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "geometry/any_solid/solid_depth.hpp"
#include "geometry/boxes/box.hpp"
#include "geometry/boxes/box_tree.hpp"
#include "mechanics/block/block_surface.hpp"
#include "solver/block_pair.hpp"

namespace ashlar {

/// The deepest point of one block in another one.
struct PairDepth {
  BlockPair blocks;    ///< the block with the point, then the one that contains it
  double depth = 0.0;  ///< m, > 0
  Vector3 place;       ///< current coordinates, m
  int face = -1;       ///< nearest face of the second block's solid
  Vector3 normal;      ///< outward unit normal of that face, current coordinates
  std::array<Vector3, 2>
      materials;  ///< the point and the closest point of the face, reference coordinates, m
};

/// A measured depth with the positions of its two material points at that time.
struct MeasuredDepth {
  PairDepth pair;
  std::array<Vector3, 2> places;  ///< current coordinates, m
};

/// Results of earlier audits: part of the state of a run. By block.
struct KnownDepths {
  std::vector<Eigen::MatrixX3d>
      positions;           ///< position of the block at the last search of all its neighbours; empty: never
  std::vector<Box> boxes;  ///< box at that position
  std::vector<MeasuredDepth> depths;  ///< of all pairs, in the order of meeting_boxes()
};

/// A ball in the reference coordinates of a solid that contains no point of the solid.
struct ClearBall {
  Vector3 center = Vector3::Zero();
  double radius = -1.0;  ///< m; negative: unknown

  /// Radius of the largest ball around another point within this one, m; negative: none.
  [[nodiscard]] double around(const Vector3& x) const { return radius - (x - center).norm(); }
};

/// A segment in the reference shape of a solid that is clear of the solid.
struct ClearSegment {
  Vector3 start = Vector3::Zero();
  Vector3 end = Vector3::Zero();
  double distance = 0.0;  ///< m, lower bound of the distance from the solid; 0: unknown

  /// True if a segment is so close to this one that it is clear too.
  [[nodiscard]] bool clears(const Vector3& from, const Vector3& to) const {
    return std::max((from - start).norm(), (to - end).norm()) < distance;
  }
};

/// Points and edges of a block that need no check against a near block that is not convex.
struct ClearParts {
  std::vector<ClearBall> points;    ///< of the surface, then those of its cells
  std::vector<ClearSegment> edges;  ///< halves of edges that may curve, one after the other
};

/// A block as an audit sees it.
struct AuditedBlock {
  std::vector<Vector3> points;        ///< of its surface, m; empty: not evaluated yet
  Box box;                            ///< of the points, grown by the distance of the surface from its cells
  std::vector<Vector3> cells;         ///< centroids of the corners of its sub-faces, m
  std::vector<Vector3> middles;       ///< of its edges, m; empty: edges are straight
  std::vector<Box> edges;             ///< empty: no other block has been near
  std::optional<BoxTree> point_tree;  ///< of points, then cells, if the block is fixed and has many
  std::optional<BoxTree> edge_tree;   ///< of edges, likewise
};

/// Scope and settings of an audit.
struct AuditScope {
  std::function<bool(int, int)> pairs;  ///< a < b; true if the two must not penetrate
  std::vector<bool> moving;             ///< by block; depths between two held blocks are ignored
  double resolution = 0.0;              ///< m, > 0: accuracy of depths of edges in solids that are not convex
  int threads = 1;
  /// m, >= 0: blocks that have moved less since their last evaluation are not measured again
  double unmoved = 0.0;
  bool fine = true;               ///< true: pairs with solids that are not convex are measured in any case
  std::vector<bool> absent = {};  ///< by block, or empty: blocks without place
};

/// Result of an audit.
struct Audit {
  std::vector<PairDepth> depths;  ///< deepest point of every ordered pair of penetrating blocks, by blocks
  /// Blocks evaluated again, with their positions; to be copied to KnownDepths together with `measured`
  std::vector<int> moved;
  std::vector<Eigen::MatrixX3d> positions;  ///< of them
  std::vector<Box> boxes;                   ///< of them
  std::vector<MeasuredDepth> measured;      ///< of all pairs, old and new

  /// Updates the results known to the next audit.
  void take_over(KnownDepths& known) const;
};

/// Caches constant data of each block between audits; results do not depend on it.
class DepthAudit {
 public:
  explicit DepthAudit(std::size_t blocks) : audited_(blocks), finders_(blocks) {}

  /// @param states finite. @param known may be empty
  [[nodiscard]] Audit run(const std::vector<BlockModel>& blocks, const std::vector<BlockState>& states,
                          const std::vector<BlockSurface>& surfaces, const AuditScope& scope,
                          const KnownDepths& known = {});
  /// To be called when the solid of a block has changed.
  void forget(std::size_t block);

 private:
  /// True if the solid of a block is convex.
  [[nodiscard]] bool is_convex(int block, const std::vector<BlockModel>& blocks);
  /// Allocates the clear parts of the first block near the second.
  void prepare(const BlockPair& blocks, std::size_t points, std::size_t edges);

  /// The deepest points of pairs of placed blocks in each other.
  [[nodiscard]] std::vector<MeasuredDepth> measure(const std::vector<PairKey>& pairs,
                                                   const std::vector<BlockModel>& blocks,
                                                   const std::vector<BlockState>& states,
                                                   const std::vector<BlockSurface>& surfaces,
                                                   const AuditScope& scope);

  std::vector<AuditedBlock> audited_;                     ///< those of fixed blocks are kept
  std::vector<std::optional<SolidDepthFinder>> finders_;  ///< of blocks that have been near others
  std::map<BlockPair, ClearParts>
      clear_;  ///< of a block (first) near another one; empty: the other one is convex
};

}  // namespace ashlar

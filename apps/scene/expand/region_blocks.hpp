// Chooses the blocks inside regions of a scene (scene_region.hpp), once its blocks, or their pieces, are known.
#pragma once

#include <memory>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/preparation.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

class ClosestPointFinder;

/// A region prepared for queries.
class RegionTest {
 public:
  /// A region that bounds no solid is reported, and contains nothing.
  /// @param scene whose folder and places are used. @param path of the region, "assign.0.inside"
  RegionTest(const Scene& scene, const SceneRegion& region, const std::string& path,
             Diagnostics& diagnostics);
  ~RegionTest();
  RegionTest(RegionTest&&) noexcept;

  /// False after a fault.
  [[nodiscard]] bool good() const { return good_; }
  /// True if a place is inside or on the boundary: decided exactly for boxes and meshes, by rounded products for
  /// half-spaces.
  [[nodiscard]] bool contains(const Vector3& place) const;

 private:
  std::variant<SceneHalfspace, SceneShape> space_;
  std::unique_ptr<const ClosestPointFinder> solid_;  ///< of shapes other than boxes
  bool good_ = true;
};

/// True if anything but a [[cut]] has a region.
[[nodiscard]] bool has_regions(const Scene& scene);

/// Replaces regions by the blocks inside. In lists of names (of stages) these are their names, of those that match
/// the names given beside `inside`; `remove` chooses among the blocks that are there in its stage, `add` among those
/// that are not; those of a drift are names too. In [[assign]] and [[joint]] they are kept in SceneRegion::blocks. A
/// [[measure]] of a block gets its name. Regions of [[cut]] are evaluated when it is made.
/// @param diagnostics reports a region without a block, and one of a measure with several
void choose_blocks_inside(Scene& scene, Diagnostics& diagnostics, Preparation* preparation = nullptr);

}  // namespace ashlar

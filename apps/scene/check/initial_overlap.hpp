// Initial overlaps of blocks of a scene. Contact springs would throw such blocks apart in the first step. So an
// overlap is an error unless the user accepts it: then contacts start without force at the initial placement
// (solver/notes/known_overlaps.md).
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "solver/block_pair.hpp"

namespace ashlar {

/// Overlap up to this is rounding: rotated blocks and meshes in single precision have errors of a few 1e-7 of their
/// size. Relative to the cube root of the smaller block's volume.
inline constexpr double allowed_initial_overlap = 1e-6;

/// Upper limit of contact.allowed_overlap, likewise relative: contacts of deeper blocks are detected on the wrong
/// sides.
inline constexpr double most_allowed_overlap = 0.1;

/// Depth of the overlap of two solids.
struct OverlapDepth {
  double depth;  ///< m; 0: they do not
  bool exact;    ///< false: the true depth may be larger
};

/// Two convex solids: the smallest translation of one that ends the overlap, decided and computed exactly.
///
/// With a nonconvex solid: the largest distance of a common point from the surface of either solid, over these
/// points: the centre of every part of an edge of one that lies inside the other, the ends of such parts, and the
/// points midway from the centre of each triangle through the solid to its opposite side. A solid that enters another
/// or lies inside it has such a point, also if both are the same. The depth found is a lower bound.
[[nodiscard]] OverlapDepth overlap_depth(const Polyhedron& a, const Polyhedron& b);

/// Two blocks with an initial overlap that is allowed.
struct KnownOverlap {
  PairKey blocks;        ///< by scene.block, the lower number first
  OverlapDepth overlap;  ///< > 0
  bool rounding;         ///< within rounding error: allowed in any case
};

/// Reports every pair of blocks whose overlap exceeds the allowed one, at the second block. Allowed are rounding
/// errors, or contact.allowed_overlap up to most_allowed_overlap. Pairs of fixed blocks may overlap.
/// @param solids one per scene.block; blocks without a solid and absent blocks are ignored
/// @return if contact.allowed_overlap is given, the pairs within it, in their order
std::vector<KnownOverlap> check_initial_overlap(const ExpandedScene& scene,
                                                const std::vector<std::optional<Polyhedron>>& solids,
                                                Diagnostics& diagnostics);

/// Warns of the pairs accepted by contact.allowed_overlap.
void warn_of_known_overlaps(const ExpandedScene& scene, const std::vector<KnownOverlap>& overlaps,
                            Diagnostics& diagnostics);

}  // namespace ashlar

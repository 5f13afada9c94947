// Blocks of a scene that overlap before anything has moved. Contact springs would throw them apart in the
// first step, so a scene that places one block inside another is at fault, unless its user accepts that: then
// contacts start without force where the blocks are placed (solver/notes/known_overlaps.md).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Overlap up to this is rounding: rotated blocks and meshes in single precision are a few 1e-7 of their size
/// off. In parts of the cube root of the smaller block's volume.
inline constexpr double allowed_initial_overlap = 1e-6;

/// Most that contact.allowed_overlap accepts, in the same parts: contacts of blocks that are deeper are found on
/// the wrong sides.
inline constexpr double most_allowed_overlap = 0.1;

/// How deep two solids overlap.
struct OverlapDepth {
  double depth;  ///< m; 0: they do not
  bool exact;    ///< false: the true depth may be larger
};

/// Two convex solids: the least translation of one that ends the overlap, decided and computed exactly.
///
/// With a solid that is not convex: the largest distance of a common point from the surface of either solid,
/// over these points: the middle of every piece of an edge of one that lies inside the other, the ends of
/// such pieces' edges, and the points half way from the middle of each triangle through the solid to its
/// other side. A solid that enters another or lies inside it has such a point, also where the two are the
/// same; the depth found is a lower bound.
[[nodiscard]] OverlapDepth overlap_depth(const Polyhedron& a, const Polyhedron& b);

/// Two blocks that are placed in each other and may be.
struct KnownOverlap {
  std::array<int, 2> blocks;  ///< by scene.block, the lower number first
  OverlapDepth overlap;       ///< > 0
  bool rounding;              ///< allowed in any case
};

/// Reports every pair of blocks that overlap by more than what is allowed, at the second one: rounding, or
/// contact.allowed_overlap up to most_allowed_overlap. Pairs of fixed blocks may overlap.
/// @param solids one per scene.block; blocks without a solid are passed over, and those that are absent
/// @return where contact.allowed_overlap is given, the pairs that overlap by no more, in their order
std::vector<KnownOverlap> check_initial_overlap(const Scene& scene,
                                                const std::vector<std::optional<Polyhedron>>& solids,
                                                Diagnostics& diagnostics);

/// Warns of the pairs that contact.allowed_overlap accepts.
void warn_of_known_overlaps(const Scene& scene, const std::vector<KnownOverlap>& overlaps,
                            Diagnostics& diagnostics);

}  // namespace ashlar

// Estimated cost of a scene before it is built. The coefficients were measured, see notes/cost_estimate.md.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Largest estimated memory if the scene has no analysis.memory_limit, bytes.
inline constexpr double default_memory_limit = 8e9;

struct CostEstimate {
  double triangles = 0.0;  ///< of all blocks
  double sub_faces = 0.0;  ///< triangles divided by contact.subdivisions; chord_tolerance may divide them
                           ///< further
  double unknowns = 0.0;   ///< of blocks that are not fixed, without supports
  double pairs = 0.0;      ///< of blocks whose boxes intersect
  double memory = 0.0;     ///< bytes, on each rank
  int ranks = 1;           ///< that share the scene
};

/// @param solids one per scene.block if known; otherwise mesh files count by their size, and pairs are not counted
/// @param ranks that share the scene: each has a part of the blocks with ghosts, and the scene itself
[[nodiscard]] CostEstimate estimate_cost(const Scene& scene,
                                         const std::vector<std::optional<Polyhedron>>* solids = nullptr,
                                         int ranks = 1);

/// "estimate: 2 blocks, 1300 sub-faces, 30 unknowns, 1 pair of near blocks, 17 MB", on several ranks
/// "..., 17 MB on each of 4 ranks"
[[nodiscard]] std::string to_string(const CostEstimate& estimate, std::size_t blocks);

/// Reports a scene whose estimate exceeds analysis.memory_limit, at the key with the largest contribution.
/// @return true if it is within the limit
bool check_cost(const Scene& scene, const CostEstimate& estimate, Diagnostics& diagnostics);

}  // namespace ashlar

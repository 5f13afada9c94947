// What a scene will take, told before it is built. The numbers per thing were measured, see
// notes/cost_estimate.md.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Bytes that an estimate may reach where the scene gives no analysis.memory_limit.
inline constexpr double default_memory_limit = 8e9;

struct CostEstimate {
  double triangles = 0.0;  ///< of all blocks
  double sub_faces = 0.0;  ///< triangles as contact.subdivisions divides them; chord_tolerance may divide on
  double unknowns = 0.0;   ///< of blocks that are not fixed, as if none were supported
  double pairs = 0.0;      ///< of blocks with boxes that meet
  double memory = 0.0;     ///< bytes
};

/// @param solids one per scene.block where they are known already; mesh files count by their size until then,
/// pairs not at all
[[nodiscard]] CostEstimate estimate_cost(const Scene& scene,
                                         const std::vector<std::optional<Polyhedron>>* solids = nullptr);

/// "estimate: 2 blocks, 1300 sub-faces, 30 unknowns, 1 pair of near blocks, 17 MB"
[[nodiscard]] std::string to_string(const CostEstimate& estimate, std::size_t blocks);

/// Reports a scene whose estimate exceeds analysis.memory_limit, at the key that makes it so large.
/// @return whether it is within the limit
bool check_cost(const Scene& scene, const CostEstimate& estimate, Diagnostics& diagnostics);

}  // namespace ashlar

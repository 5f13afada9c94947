// analysis.movement: range of support movements in text, in the summary and as a drawing.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/paths/support_movement.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Supports named in analysis.movement.supports, in the order of blocks. @param model of limit_model
[[nodiscard]] std::vector<int> moved_supports(const Scene& scene, const RigidModel& model);

/// Reports movements that cannot be followed: a name of no support, partly supported blocks, no load.
/// @param model of limit_model
void refuse_movements(const Scene& scene, const std::optional<RigidModel>& model, Diagnostics& diagnostics);

struct MovementRequest {
  int support;  ///< block
  int threads = 1;
  std::function<bool()> may_continue;  ///< called before each step; false ends the search
};
/// Movement with the limit and the tolerance of the scene, or those derived from its size.
[[nodiscard]] SupportMovement find_movement(const Scene& scene, const RigidModel& model,
                                            const Simulation& simulation, const MovementRequest& request);

/// The two ways of a movement: "out" and "in", "along its direction" and "against it", "apart" and "together".
[[nodiscard]] std::pair<const char*, const char*> senses_in_words(const SupportMovement& movement);

/// "left can move 0.141 m out (collapses at 0.1411 m), 0.072 m in (...)"
[[nodiscard]] std::string describe(const SupportMovement& movement, const Simulation& simulation);

/// direction (null: it spreads), out and in: lower, upper (m; null: none was found), status, thrust (rows of m and
/// N), joints (blocks, place, rotation in degrees, slip in m, pressed) and moving.
[[nodiscard]] nlohmann::ordered_json movement_summary(const SupportMovement& movement,
                                                      const Simulation& simulation);

/// Draws the blocks at the last equilibrium of the first support's outward movement, and its hinges. Does nothing
/// without movements.
/// @throws std::runtime_error with path and reason
void draw_movement(const std::vector<SupportMovement>& movements, const Scene& scene,
                   const Simulation& simulation, const std::filesystem::path& path);

}  // namespace ashlar

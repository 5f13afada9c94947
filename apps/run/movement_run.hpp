// analysis.movement: how far supports can move, in words, in the summary and as a drawing.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene_loading.hpp"
#include "solver/run/simulation.hpp"
#include "solver/statics/support_movement.hpp"

namespace ashlar {

/// Supports that the scene names in analysis.movement.supports, in the order of blocks. @param model of limit_model
[[nodiscard]] std::vector<int> moved_supports(const Scene& scene, const RigidModel& model);

/// Refuses movements that cannot be followed: a name that is no support's, blocks that are held in part, no load.
/// @param model of limit_model
void refuse_movements(const Scene& scene, const std::optional<RigidModel>& model, Diagnostics& diagnostics);

struct MovementRequest {
  int support;  ///< block
  int threads = 1;
  std::function<bool()> goes_on;  ///< asked before each step
};
/// With the limit and the tolerance of the scene, or those that follow from its size.
[[nodiscard]] SupportMovement find_movement(const Scene& scene, const RigidModel& model,
                                            const Simulation& simulation, const MovementRequest& request);

/// Nothing is known beyond its last equilibrium in one of the directions.
[[nodiscard]] bool is_open(const SupportMovement& movement);

/// "left can move 0.141 m out (collapses at 0.1411 m), 0.072 m in (...)"
[[nodiscard]] std::string describe(const SupportMovement& movement, const Simulation& simulation);

/// direction (null: it spreads), out and in: lower, upper (m; null: none was found), status, thrust (rows of m and N),
/// joints (blocks, place, rotation in degrees, slip in m, pressed) and moving.
[[nodiscard]] nlohmann::ordered_json movement_summary(const SupportMovement& movement,
                                                      const Simulation& simulation);

/// Blocks at the last equilibrium of the first support's way out, and its hinges. Nothing if there is no movement.
/// @throws std::runtime_error with path and reason
void draw_movement(const std::vector<SupportMovement>& movements, const Scene& scene,
                   const Simulation& simulation, const std::filesystem::path& path);

}  // namespace ashlar

// analysis.type "thrust": the least and the largest thrust on each support in text, in the summary and as a drawing.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/run/answers/answer.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// @param model of limit_model. @param may_continue called during movements; false interrupts the last one
[[nodiscard]] ThrustFindings find_thrust(const Scene& scene, RigidModel model, const Simulation& simulation,
                                         int threads, const std::function<bool()>& may_continue);

/// "thrust on abutment between 1.2e+04 and 3.4e+04 N; ..."
[[nodiscard]] std::string describe(const ThrustFindings& findings, const Simulation& simulation);

/// An array: support, least and most (N; null: unbounded), gap, least_line and most_line, each an array of blocks,
/// place (m) and force (N, on the first block); least_bolts and most_bolts (limit_run.hpp) of scenes with bolts; movement
/// (movement_run.hpp) for supports that were moved.
[[nodiscard]] nlohmann::ordered_json thrust_summary(const ThrustFindings& findings,
                                                    const Simulation& simulation);

/// The states of the answer: of the least and largest thrust of each support, and of the ends of movements.
[[nodiscard]] std::vector<ShownState> thrust_states(const ThrustFindings& findings,
                                                    const Simulation& simulation);

/// Draws moving blocks, projected along the horizontal direction of their smallest extent, and the lines of least and
/// largest thrust on the first support, as SVG. @throws std::runtime_error with path and reason
void draw_thrust(const ThrustFindings& findings, const Scene& scene, const Simulation& simulation,
                 const std::filesystem::path& path);

}  // namespace ashlar

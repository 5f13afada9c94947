// analysis.type "thrust": the least and the most thrust on each support, in words, in the summary and as a drawing.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/scene/scene_loading.hpp"
#include "solver/run/simulation.hpp"
#include "solver/statics/support_movement.hpp"
#include "solver/statics/thrust.hpp"

namespace ashlar {

/// An extreme of the thrust on one support, and the line of thrust that goes with it.
struct ThrustLine {
  double thrust = 0.0;  ///< N
  double gap = 0.0;
  std::vector<JointResultant> joints;
};
struct SupportThrust {
  int support = -1;  ///< block
  ThrustLine least;
  std::optional<ThrustLine> most;  ///< empty: no bound
};

struct ThrustFindings {
  std::vector<SupportThrust> supports;
  std::vector<SupportMovement> movements;  ///< of supports that the scene moves, in the order of blocks
  std::string collapse;  ///< what moves, if no forces within the strengths balance the loads
};

/// @param model of limit_model. @param goes_on asked while supports move; if not, the last movement was interrupted
[[nodiscard]] ThrustFindings find_thrust(const Scene& scene, RigidModel model, const Simulation& simulation,
                                         int threads, const std::function<bool()>& goes_on);

/// "thrust on abutment between 1.2e+04 and 3.4e+04 N; ..."
[[nodiscard]] std::string describe(const ThrustFindings& findings, const Simulation& simulation);

/// An array: support, least and most (N; null: no bound), gap, least_line and most_line, each an array of blocks, place
/// (m) and force (N, on the first block); movement (movement_run.hpp) of supports that were moved.
[[nodiscard]] nlohmann::ordered_json thrust_summary(const ThrustFindings& findings,
                                                    const Simulation& simulation);

/// Blocks that may move, seen along the horizontal direction in which they extend least, and the lines of least and most
/// thrust on the first support, as an SVG drawing. @throws std::runtime_error with path and reason
void draw_thrust(const ThrustFindings& findings, const Scene& scene, const Simulation& simulation,
                 const std::filesystem::path& path);

}  // namespace ashlar

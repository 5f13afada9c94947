// Time and memory of the steps of a simulation.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Cost of some steps. Plain numbers, as they come from another process.
struct RunCost {
  double unknowns = 0.0;   ///< of all blocks that are not fixed
  double points = 0.0;     ///< contact points a step, of all steps
  double building = 0.0;   ///< processor seconds until the first step
  double seconds = 0.0;    ///< processor seconds of the measured steps
  double worst = 0.0;      ///< of one of them
  double wall = 0.0;       ///< wall seconds of them
  double mebibytes = 0.0;  ///< growth of the process
};

/// Makes a simulation; empty: it cannot be built.
using MakeSimulation = std::function<std::optional<Simulation>()>;

/// @param text of a scene. @return makes its simulation
[[nodiscard]] MakeSimulation scene_of_text(const std::string& text, int threads = 1);

/// Measures in a process of its own: memory that other work has left would hide what this one needs.
/// @param skipped steps before the measured ones, >= 0. @param steps measured, > 0
/// @return empty if the simulation cannot be built, a step is not accepted or the process cannot be started
[[nodiscard]] std::optional<RunCost> cost_of_run(const MakeSimulation& make, int skipped, int steps);

}  // namespace ashlar

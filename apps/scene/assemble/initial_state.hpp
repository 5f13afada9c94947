// analysis.initial_state = "equilibrium" and "static", and blocks that stay as placed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Settles the blocks that are restrained by their own supports (Simulation::settle_supported_blocks). Warns if there
/// are none, and of each block whose equilibrium was not found (its load buckles it). An equilibrium that inverts a
/// corner of a block is an error: a soft block under a large load.
/// @return the names of the moving blocks that start as placed: those with a rigid motion, tied ones, and those
/// without equilibrium
std::vector<std::string> start_in_equilibrium(const Scene& scene, Simulation& simulation,
                                              Diagnostics& diagnostics);

/// Result of initial_state = "static".
struct StaticStart {
  enum class End {
    answered,     ///< motion may begin
    failed,       ///< no result was found
    interrupted,  ///< the analysis was interrupted, and nothing is kept
  };
  End end = End::answered;
  std::string message;  ///< message to the user; empty: all supported blocks are in equilibrium
};
/// Moves the blocks to their static state (Simulation::start_from_statics). Without equilibrium they start as placed.
/// @param may_continue called before each iteration; false ends the analysis
[[nodiscard]] StaticStart start_in_statics(Simulation& simulation, const std::function<bool()>& may_continue);

/// "A, B, C, D, E and 3 more": the first names.
[[nodiscard]] std::string first_names(const std::vector<std::string>& names);

}  // namespace ashlar

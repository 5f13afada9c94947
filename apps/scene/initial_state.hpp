// analysis.initial_state = "equilibrium", and whom it leaves as placed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// Settles the blocks that their own supports hold (Simulation::settle_supported_blocks). Warns where that is
/// none, and of each block that they hold but whose equilibrium was not found (its load buckles it). An
/// equilibrium that turns a corner of a block inside out is an error: a soft block under a large load.
/// @return the names of the moving blocks that start as placed: those with a rigid motion left, tied ones,
/// and those without equilibrium
std::vector<std::string> start_in_equilibrium(const Scene& scene, Simulation& simulation,
                                              Diagnostics& diagnostics);

/// What initial_state = "static" came to.
struct StaticStart {
  enum class End {
    answered,     ///< motion may begin
    failed,       ///< no answer was found
    interrupted,  ///< it was told to stop, and nothing is kept
  };
  End end = End::answered;
  std::string message;  ///< to the user; empty: all blocks that are held are in equilibrium
};
/// Takes the blocks to their static state (Simulation::start_from_statics). Where nothing is in balance they
/// start as placed. @param goes_on asked before each iteration
[[nodiscard]] StaticStart start_in_statics(Simulation& simulation, const std::function<bool()>& goes_on);

/// "A, B, C, D, E and 3 more": the first names.
[[nodiscard]] std::string first_names(const std::vector<std::string>& names);

}  // namespace ashlar

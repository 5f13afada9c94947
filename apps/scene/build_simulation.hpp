// From a checked scene to a simulation: materials, supports, loads, joint laws and every number left to the
// program.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "apps/scene/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// What the scene left to the program.
struct AutomaticChoice {
  std::string key;  ///< as in the scene, e.g. "contact.distance"
  std::variant<double, bool> value;
  std::string unit;
};

/// A simulation ready for its first step.
struct BuiltSimulation {
  Simulation simulation;
  std::vector<AutomaticChoice> choices;
  std::size_t different_blocks;  ///< that share neither basis and stiffness nor supports with others
  /// Moving blocks that an initial_state of equilibrium does not settle.
  std::vector<std::string> as_placed;
  std::vector<KnownOverlap> overlaps;  ///< of the scene, see LoadedScene
};

/// What a search for a factor makes of a scene (analysis.safety, analysis.capacity).
struct TrialFactors {
  double strength =
      1.0;            ///< > 0; tan(phi), cohesion and tensile strength of the chosen joints are divided by it
  double load = 1.0;  ///< > 0; loads of the chosen blocks are multiplied by it
};

/// @param threads >= 1
/// @return nothing if a block cannot be built (named in diagnostics at its key)
[[nodiscard]] std::optional<BuiltSimulation> build_simulation(const LoadedScene& loaded, int threads,
                                                              Diagnostics& diagnostics,
                                                              Preparation* preparation = nullptr,
                                                              const TrialFactors& factors = {});

}  // namespace ashlar

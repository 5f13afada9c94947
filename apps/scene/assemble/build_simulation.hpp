// From a checked scene to a simulation: materials, supports, loads, joint laws and all automatic values.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "apps/scene/assemble/run_ranks.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// A value chosen by the program.
struct AutomaticChoice {
  std::string key;  ///< as in the scene, e.g. "contact.distance"
  std::variant<double, bool, std::string> value;
  std::string unit;
  std::string reason = {};  ///< empty: none is told
};

/// A simulation ready for its first step.
struct BuiltSimulation {
  Simulation simulation;
  std::vector<AutomaticChoice> choices;
  std::size_t different_blocks;  ///< number of blocks without equal ones
  /// Moving blocks not settled by an initial_state of equilibrium.
  std::vector<std::string> as_placed;
  std::vector<KnownOverlap> overlaps;  ///< of the scene, see LoadedScene
  /// Kept for several ranks, which make models of blocks that come near later; null: it is kept elsewhere
  std::shared_ptr<const LoadedScene> scene = nullptr;
};

/// Changes of a scene by a search for a factor (analysis.safety, analysis.capacity).
struct TrialFactors {
  double strength =
      1.0;            ///< > 0; tan(phi), cohesion and tensile strength of the chosen joints are divided by it
  double load = 1.0;  ///< > 0; loads of the chosen blocks are multiplied by it
};

/// @param threads >= 1
/// @param ranks that share the simulation, with the same scene; null: it is this one's alone. The scene must then outlive
/// the simulation. Collective if there are no errors, which are those of all ranks
/// @return empty if a block cannot be built (reported at its key)
[[nodiscard]] std::optional<BuiltSimulation> build_simulation(const LoadedScene& loaded, int threads,
                                                              Diagnostics& diagnostics,
                                                              Preparation* preparation = nullptr,
                                                              const TrialFactors& factors = {},
                                                              const RunRanks* ranks = nullptr);

}  // namespace ashlar

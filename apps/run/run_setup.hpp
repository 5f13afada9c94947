// Simulations that a run starts with: that of its first stage, checked, and those of later ones.
#pragma once

#include <memory>
#include <optional>

#include "apps/run/run_group.hpp"
#include "apps/scene/assemble/build_simulation.hpp"
#include "apps/scene/assemble/scene_loading.hpp"

namespace ashlar {

/// One stage of a scene, or the scene itself if it has none. @param whole not null
[[nodiscard]] std::shared_ptr<const LoadedScene> stage_scene(const std::shared_ptr<const LoadedScene>& whole,
                                                             std::size_t stage);

/// Builds the first stage. Reports blocks that cannot be built, unsupported blocks of a static analysis, searches
/// with nothing to find, and cracks without joints. Of several processes the first one alone reports the last two.
/// @param first of stage_scene(), kept with the result. @param threads >= 1. @param group collective; the scene must
/// be the same on all processes
/// @return empty if a block cannot be built
[[nodiscard]] std::optional<BuiltSimulation> build_first_stage(std::shared_ptr<const LoadedScene> first,
                                                               int threads, Diagnostics& diagnostics,
                                                               Preparation* preparation = nullptr,
                                                               const RunGroup& group = {});

/// The simulation of a stage. @throws std::runtime_error if its blocks cannot be built
[[nodiscard]] BuiltSimulation built_or_thrown(const LoadedScene& stage, int threads);
/// The same for a group of processes. Collective. @param stage not null, kept with the result
[[nodiscard]] BuiltSimulation built_stage(std::shared_ptr<const LoadedScene> stage, int threads,
                                          const RunGroup& group, const TrialFactors& factors = {});

}  // namespace ashlar

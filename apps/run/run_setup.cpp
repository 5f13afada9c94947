#include "apps/run/run_setup.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "apps/results/tables/group_measure.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "apps/run/answers/movement_run.hpp"
#include "apps/scene/check/loose_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"

namespace ashlar {
namespace {

/// A crack is measured on faces that touch as placed, in any stage.
void refuse_idle_cracks(const Scene& scene, const std::vector<BlockModel>& blocks, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < scene.measure.size(); ++k) {
    const std::optional<SceneCrack>& crack = scene.measure[k].crack;
    if (crack && joint_polygons(scene, *crack, blocks).polygons.empty())
      diagnostics.error(scene.places.key(fmt::format("measure.{}.crack", k)),
                        "no faces of these blocks touch (0 joints), at least one joint is needed");
  }
}

/// @param placed all blocks as placed
void refuse_idle_searches(const Scene& scene, const Simulation& placed, Diagnostics& diagnostics) {
  const std::optional<RigidModel> model = limit_model(scene, placed);
  refuse_idle_limits(scene, placed, model, diagnostics);
  refuse_movements(scene, model, diagnostics);
}

/// @throws std::runtime_error with the first fault
BuiltSimulation built_with(const LoadedScene& stage, int threads, const TrialFactors& factors,
                           const RunRanks* ranks) {
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> built =
      build_simulation(stage, threads, diagnostics, nullptr, factors, ranks);
  if (built) return std::move(*built);
  const std::vector<Diagnostic> faults = diagnostics.sorted();
  throw std::runtime_error(faults.empty() ? "blocks cannot be built" : to_string(faults.front()));
}

}  // namespace

std::shared_ptr<const LoadedScene> stage_scene(const std::shared_ptr<const LoadedScene>& whole,
                                               std::size_t stage) {
  if (whole->scene.stage.empty()) return whole;
  return std::make_shared<const LoadedScene>(stage_of(*whole, stage));
}

std::optional<BuiltSimulation> build_first_stage(std::shared_ptr<const LoadedScene> first, int threads,
                                                 Diagnostics& diagnostics, Preparation* preparation,
                                                 const RunRanks* ranks) {
  const Scene& scene = first->scene;
  std::optional<BuiltSimulation> built =
      build_simulation(*first, threads, diagnostics, preparation, {}, ranks);
  if (built) built->scene = first;
  if (built && is_static(scene.analysis)) refuse_loose_blocks(scene, built->simulation, diagnostics);
  if (!built || !diagnostics.good()) return built;
  if (ranks == nullptr || !ranks->several()) {
    refuse_idle_searches(scene, built->simulation, diagnostics);
  } else if (ranks->first() && seeks_answer(scene.analysis)) {
    const BuiltSimulation whole = built_or_thrown(*first, threads);
    refuse_idle_searches(scene, whole.simulation, diagnostics);
  }
  // Other ranks have no models of blocks elsewhere.
  if (ranks == nullptr || ranks->first()) refuse_idle_cracks(scene, built->simulation.blocks(), diagnostics);
  return built;
}

BuiltSimulation built_or_thrown(const LoadedScene& stage, int threads) {
  return built_with(stage, threads, {}, nullptr);
}

BuiltSimulation built_stage(std::shared_ptr<const LoadedScene> stage, int threads, const RunRanks* ranks,
                            const TrialFactors& factors) {
  BuiltSimulation built = built_with(*stage, threads, factors, ranks);
  built.scene = std::move(stage);
  return built;
}

}  // namespace ashlar

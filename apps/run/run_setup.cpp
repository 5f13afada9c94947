#include "apps/run/run_setup.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "apps/results/tables/group_measure.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "apps/run/answers/movement_run.hpp"
#include "apps/run/answers/pushover_run.hpp"
#include "apps/scene/assemble/cracking_blocks.hpp"
#include "apps/scene/check/warnings/loose_blocks.hpp"
#include "apps/scene/expand/scene_stages.hpp"

namespace ashlar {
namespace {

/// A crack is measured on faces that touch as placed, in any stage.
void refuse_idle_cracks(const Scene& scene, const std::vector<BlockModel>& blocks, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < scene.measure.size(); ++k) {
    const std::optional<SceneCrack>& crack = scene.measure[k].crack;
    if (crack && scene.crack.empty() && joint_polygons(scene, *crack, blocks).polygons.empty())
      diagnostics.error(scene.places.key(fmt::format("measure.{}.crack", k)),
                        "no faces of these blocks touch (0 joints), at least one joint is needed");
  }
}

/// @param placed all blocks as placed
void refuse_idle_searches(const Scene& scene, const Simulation& placed, Diagnostics& diagnostics) {
  const std::optional<RigidModel> model = limit_model(scene, placed);
  refuse_idle_limits(scene, model, diagnostics);
  refuse_movements(scene, model, diagnostics);
  refuse_pushover(scene, model, diagnostics);
}

/// @throws std::runtime_error with the first fault
BuiltSimulation built_with(const LoadedScene& stage, int threads, const TrialFactors& factors,
                           const RunGroup& group) {
  Diagnostics diagnostics;
  std::optional<BuiltSimulation> built =
      build_simulation(stage, threads, diagnostics, nullptr, factors, group.ranks());
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
                                                 const RunGroup& group) {
  const Scene& scene = first->scene;
  std::optional<BuiltSimulation> built =
      build_simulation(*first, threads, diagnostics, preparation, {}, group.ranks());
  if (built) built->scene = first;
  if (built && is_static(scene.analysis)) refuse_loose_blocks(scene, built->simulation, diagnostics);
  if (built) check_cracking(scene, built->simulation, diagnostics);
  if (!built || !diagnostics.good()) return built;
  if (!group.shared()) {
    refuse_idle_searches(scene, built->simulation, diagnostics);
  } else if (group.first() && seeks_answer(scene.analysis)) {
    const BuiltSimulation whole = built_or_thrown(*first, threads);
    refuse_idle_searches(scene, whole.simulation, diagnostics);
  }
  // Other processes have no models of blocks elsewhere.
  if (group.first()) refuse_idle_cracks(scene, built->simulation.blocks(), diagnostics);
  return built;
}

BuiltSimulation built_or_thrown(const LoadedScene& stage, int threads) {
  return built_with(stage, threads, {}, {});
}

BuiltSimulation built_stage(std::shared_ptr<const LoadedScene> stage, int threads, const RunGroup& group,
                            const TrialFactors& factors) {
  BuiltSimulation built = built_with(*stage, threads, factors, group);
  built.scene = std::move(stage);
  return built;
}

}  // namespace ashlar

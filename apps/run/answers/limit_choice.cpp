#include "apps/run/answers/limit_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/run/answers/crushing_run.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/scene/assemble/limit_choices.hpp"
#include "mechanics/bolt/bolt_strength.hpp"

namespace ashlar {
namespace {

/// True for answers that rigid blocks alone have.
bool is_of_rigid_blocks(const SceneAnalysis& analysis) {
  return analysis.type == SceneAnalysis::Type::thrust || analysis.type == SceneAnalysis::Type::pushover;
}

}  // namespace

std::string lacking_bolt(const Simulation& simulation) {
  for (const Bolt& bolt : simulation.system().bolts()) {
    const BoltLaw& law = bolt.chain.law();
    const char* missing = std::isinf(bolt_strength(law).shear)       ? "has no shear_strength"
                          : is_unlimited(law)                        ? "has no yield_force"
                          : law.rupture_strain != BoltLaw::unlimited ? "breaks (rupture_strain)"
                                                                     : nullptr;
    if (missing != nullptr) return fmt::format("{} {}", bolt.name, missing);
  }
  return "";
}

std::optional<RigidModel> limit_model(const Scene& scene, const Simulation& simulation) {
  const bool rigid = is_of_rigid_blocks(scene.analysis);
  const bool asks = seeks_factor(scene.analysis) || rigid;
  if (!asks || scene.analysis.formulation == SceneAnalysis::Formulation::incremental) return std::nullopt;
  const bool by_choice = rigid || scene.analysis.method == SceneAnalysis::Method::limit;
  if (!by_choice && !simulation.bolts().empty() &&
      (scene.analysis.method == SceneAnalysis::Method::elastic || !lacking_bolt(simulation).empty()))
    return std::nullopt;
  const bool multiplies = scene.analysis.type == SceneAnalysis::Type::capacity;
  const bool pushes =
      scene.analysis.type == SceneAnalysis::Type::pushover && !scene.analysis.pushover.blocks.empty();
  RigidModel model = simulation.rigid_model(scene.analysis.end_time, multiplies ? multiplied_blocks(scene)
                                                                     : pushes   ? pushed_by_loads(scene)
                                                                                : std::vector<bool>());
  if (by_choice) keep_residual_strength(model);
  return model;
}

MethodChoice choose_method(const Scene& scene, const Simulation& simulation,
                           const std::optional<RigidModel>& model) {
  if (!seeks_factor(scene.analysis) || scene.analysis.method == SceneAnalysis::Method::elastic) return {};
  if (scene.analysis.method == SceneAnalysis::Method::limit) return {model.has_value(), ""};
  if (scene.analysis.formulation == SceneAnalysis::Formulation::incremental)
    return {false, "limit analysis has no incremental formulation"};
  if (!model) return {false, lacking_bolt(simulation) + ", which limit analysis needs"};
  if (loses_strength(*model)) return {false, "joints lose strength as they fail"};
  // Stress of the ground clamps blocks, which limit analysis begins without.
  if (scene.initial_stress.given()) return {false, "the ground has stress at the start"};
  return {true, "joints and bolts keep their strength"};
}

namespace {

/// True if any joint loses strength at once.
bool is_brittle(const RigidModel& model) {
  return std::any_of(model.points.begin(), model.points.end(), [](const RigidPoint& point) {
    const PointLaw law = point_law(point.law, 1.0, true);
    return !point.bar && !law.bond.softens() && law.weakens();
  });
}

/// Tells which strength an answer is for where joints lose it.
void warn_of_lost_strength(const Scene& scene, const RigidModel& model, Diagnostics& diagnostics) {
  const bool rigid = is_of_rigid_blocks(scene.analysis);
  const bool chosen = scene.places.contains("analysis.method");
  const Place place = scene.places.value(chosen ? "analysis.method" : "analysis.type");
  if (model.has_residual_strength) {
    diagnostics.warning(
        place, fmt::format("joints lose strength when they fail: limit analysis has their residual strength, "
                           "the safe side{}",
                           rigid ? "" : "; analysis.method = \"elastic\" follows their failure"));
  } else if (seeks_factor(scene.analysis) && is_brittle(model)) {
    diagnostics.warning(
        place,
        "joints that lose strength fail point by point: the factor depends "
        "on the order and stiffness of blocks by some percent, and is not a bound. Compare "
        "orders, or give fracture_energy; analysis.method = \"limit\" has the residual strength, "
        "the safe side");
  }
}

}  // namespace

void refuse_idle_limits(const Scene& scene, const std::optional<RigidModel>& model,
                        Diagnostics& diagnostics) {
  const bool rigid = is_of_rigid_blocks(scene.analysis);
  warn_of_idle_crushing(scene, model, diagnostics);
  if (!model) {
    if (rigid || (seeks_factor(scene.analysis) && scene.analysis.method == SceneAnalysis::Method::limit))
      diagnostics.error(
          scene.places.value("analysis.formulation"),
          "limit analysis of the incremental formulation (\"incremental\"), \"total\" is needed");
    return;
  }
  if (model->bodies.empty()) {
    diagnostics.error(scene.places.value("analysis.type"),
                      "no block can move (all are fixed or held by supports), one that can is needed");
    return;
  }
  warn_of_lost_strength(scene, *model, diagnostics);
  if (seeks_factor(scene.analysis) && scene.analysis.method == SceneAnalysis::Method::limit &&
      scene.initial_stress.given())
    diagnostics.warning(scene.places.key("initial_stress"),
                        "limit analysis begins without it: blocks that it clamps may move below the factor; "
                        "analysis.method = \"elastic\" has it");
  if (scene.analysis.type == SceneAnalysis::Type::capacity && !multiplies_loads(*model))
    diagnostics.error(scene.places.value("analysis.capacity.blocks"),
                      "loads to multiply move no block (0 N in all), one that can move a block is needed");
}

}  // namespace ashlar

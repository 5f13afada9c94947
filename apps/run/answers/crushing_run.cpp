#include "apps/run/answers/crushing_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/run/answers/block_name.hpp"
#include "apps/run/answers/factor_analysis.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "apps/scene/check/joint_tables.hpp"

namespace ashlar {
namespace {

/// Pa: strength of weak masonry, which a scene without a strength may rely on.
constexpr double ordinary_strength = 2e6;
/// Bodies up to which the plastic limit of joints that crush is searched for the strength that they need.
constexpr std::size_t most_bodies = 12;

std::string megapascals(double strength) {
  return fmt::format("{:.3g} MPa", 1e-6 * strength);
}

std::string joint_in_words(const LeastStrength& least, const Simulation& simulation) {
  return fmt::format("between {} and {}", block_name(simulation, least.joint[0]),
                     block_name(simulation, least.joint[1]));
}

}  // namespace

void warn_of_idle_crushing(const Scene& scene, const std::optional<RigidModel>& model,
                           Diagnostics& diagnostics) {
  const std::optional<std::string> given = first_given(scene, "compressive_strength");
  if (!given) return;
  if (!model) return;
  const auto count = std::count_if(model->points.begin(), model->points.end(),
                                   [](const RigidPoint& point) { return crushes(point) && !point.part; });
  if (count > 0)
    diagnostics.warning(
        scene.places.key(*given),
        fmt::format("blocks touch at {} points or edges, which have no area and do not crush", count));
}

CrushingFindings find_crushing(const LimitAnalysis& analysis, const PathAnswer& path,
                               const SceneAnalysis& asked, int threads) {
  CrushingFindings findings;
  const std::optional<double>& lower = path.lower;
  const bool safety = asked.type == SceneAnalysis::Type::safety;
  const RigidModel& model = analysis.model();
  findings.given = std::numeric_limits<double>::infinity();
  for (const RigidPoint& point : model.points)
    if (crushes(point)) findings.given = std::min(findings.given, point.law.compressive_strength);
  if (!std::isfinite(findings.given)) {
    if (path.least_strength > 0.0) findings.least = {path.least_strength, path.strength_joint};
    if (lower && model.bodies.size() <= most_bodies) {
      const auto plastic = least_strength(
          model, analysis.reduced(), safety ? LimitFactors{*lower, 1.0} : LimitFactors{1.0, *lower}, threads);
      if (plastic) findings.least = *plastic;
    }
    return findings;
  }
  if (lower && (!safety || *lower >= 1.0)) return findings;
  const auto needed = least_strength(model, analysis.reduced(), {1.0, safety ? 1.0 : 0.0}, threads);
  if (needed && needed->value > findings.given) findings.needed = *needed;
  return findings;
}

std::string crushing_in_words(const CrushingFindings& findings, const Simulation& simulation) {
  if (findings.needed.value == 0.0) return "";
  return fmt::format(
      "joints crush under the loads without a factor: compressive_strength is {}, at least {} is needed {}",
      megapascals(findings.given), megapascals(findings.needed.value),
      joint_in_words(findings.needed, simulation));
}

std::string strength_warning(const CrushingFindings& findings, const Simulation& simulation) {
  if (findings.least.value <= ordinary_strength) return "";
  return fmt::format(
      "the answer needs a compressive strength of {}, {}: give compressive_strength if joints or blocks have "
      "less",
      megapascals(findings.least.value), joint_in_words(findings.least, simulation));
}

nlohmann::ordered_json least_strength_json(const CrushingFindings& findings, const Simulation& simulation) {
  const LeastStrength& least = findings.needed.value > 0.0 ? findings.needed : findings.least;
  if (least.value == 0.0) return nullptr;
  return {{"value", least.value},
          {"joint", nlohmann::ordered_json{block_name(simulation, least.joint[0]),
                                           block_name(simulation, least.joint[1])}}};
}

}  // namespace ashlar

#include "apps/scene/check/crushing_checks.hpp"

#include <fmt/format.h>

#include "apps/scene/check/joint_tables.hpp"
#include "apps/scene/model/scene_names.hpp"

namespace ashlar {
namespace {

/// A tensile strength above the compressive one.
void check_against_tension(const JointTablePath& table, JointFaults& faults) {
  const SceneJointLaw& law = table.law;
  if (!law.compressive_strength || law.tied || law.tensile_strength <= *law.compressive_strength) return;
  faults.report(
      table, {"compressive_strength", "tensile_strength", "tied"},
      fmt::format("compressive_strength is below tensile_strength ({} Pa, {} Pa), at least {} Pa is needed",
                  *law.compressive_strength, law.tensile_strength, law.tensile_strength),
      true);
}

/// An analysis without joints that crush; empty: it has them.
std::string analysis_without_crushing(const SceneAnalysis& analysis) {
  if (!analysis.movement.supports.empty()) return "a movement of supports";
  if (analysis.type == SceneAnalysis::Type::pushover) return "a pushover";
  return "";
}

/// True if springs of joints may decide: only rigid blocks have joints that crush beside all other properties.
bool may_have_springs(const Scene& scene) {
  const SceneAnalysis& analysis = scene.analysis;
  switch (analysis.type) {
    case SceneAnalysis::Type::dynamic:
    case SceneAnalysis::Type::statics:
      return true;
    case SceneAnalysis::Type::safety:
    case SceneAnalysis::Type::capacity:
      return !scene.stage.empty() || analysis.method != SceneAnalysis::Method::limit;
    default:
      return !scene.stage.empty();
  }
}

/// Properties that springs which crush do not have.
void check_other_properties(const Scene& scene, const JointTablePath& table, JointFaults& faults) {
  const SceneJointLaw& law = table.law;
  if (!law.compressive_strength || law.tied || !may_have_springs(scene)) return;
  const auto exclude = [&](const char* key, bool has) {
    if (has)
      faults.report(
          table, {key, "compressive_strength"},
          fmt::format("{} beside compressive_strength; a joint that crushes in motion or statics has "
                      "friction, cohesion and tensile strength alone: leave one of the two out, or give "
                      "analysis.method = \"limit\"",
                      key));
  };
  exclude("dilation_angle", law.dilation_angle > 0.0);
  exclude("damping", law.damping > 0.0);
  exclude("fracture_energy", law.fracture_energy.has_value());
}

}  // namespace

std::optional<std::string> first_compressive_strength(const Scene& scene) {
  return first_given(scene, "compressive_strength");
}

void check_compressive_strengths(const Scene& scene, Diagnostics& diagnostics) {
  const std::optional<std::string> first = first_compressive_strength(scene);
  if (!first) return;
  JointFaults faults(scene, diagnostics);
  for (const JointTablePath& table : tables_of_joints(scene)) {
    check_against_tension(table, faults);
    check_other_properties(scene, table, faults);
  }
  const std::string analysis = analysis_without_crushing(scene.analysis);
  if (analysis.empty()) return;
  diagnostics.error(
      scene.places.key(*first),
      fmt::format("compressive_strength in {}, where joints do not crush; leave it out", analysis));
}

}  // namespace ashlar

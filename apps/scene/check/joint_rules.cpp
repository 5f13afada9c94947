#include "apps/scene/check/joint_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <vector>

#include "apps/scene/check/joint_tables.hpp"

namespace ashlar {
namespace {

/// Reports the first of these keys beside the last one. @param keys at which it is reported, the first that is given
void exclude(const JointTablePath& table, bool has, std::initializer_list<const char*> keys,
             const char* reason, JointFaults& faults) {
  if (has)
    faults.report(table, keys, fmt::format("{} beside {}; {}", *keys.begin(), *(keys.end() - 1), reason));
}

void need_area_springs(const Scene& scene, const JointTablePath& table, const char* key,
                       JointFaults& faults) {
  if (scene.contact.springs != SceneContact::Springs::area)
    faults.report(
        table, {key},
        fmt::format("{} with point springs, which have no pressure; springs = \"area\" is needed", key));
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

void check_crushing(const Scene& scene, const JointTablePath& table, JointFaults& faults) {
  const SceneJointLaw& law = table.law;
  if (!law.compressive_strength) return;
  if (law.tensile_strength > *law.compressive_strength)
    faults.report(table, {"compressive_strength", "tensile_strength", "tied"},
                  fmt::format("compressive_strength is below tensile_strength ({} Pa, {} Pa), at least {} Pa "
                              "is needed",
                              *law.compressive_strength, law.tensile_strength, law.tensile_strength),
                  true);
  if (!may_have_springs(scene)) return;
  constexpr const char* reason =
      "a joint that crushes in motion or statics has friction, cohesion and tensile strength alone: leave "
      "one of the two out, or give analysis.method = \"limit\"";
  exclude(table, law.dilation_angle > 0.0, {"dilation_angle", "compressive_strength"}, reason, faults);
  exclude(table, law.damping > 0.0, {"damping", "compressive_strength"}, reason, faults);
  exclude(table, law.fracture_energy.has_value(), {"fracture_energy", "compressive_strength"}, reason,
          faults);
}

void check_roughness(const Scene& scene, const JointTablePath& table, JointFaults& faults) {
  const SceneJointLaw& law = table.law;
  if (!law.roughness) return;
  constexpr const char* reason =
      "a rough joint has the strength of its roughness, of friction_angle and cohesion: leave one of the two "
      "out";
  exclude(table, law.friction_angle_residual.has_value(), {"friction_angle_residual", "roughness"}, reason,
          faults);
  exclude(table, law.compressive_strength.has_value(), {"compressive_strength", "roughness"}, reason, faults);
  exclude(table, law.fracture_energy.has_value(), {"fracture_energy", "roughness"}, reason, faults);
  need_area_springs(scene, table, "roughness", faults);
}

void check_closure(const Scene& scene, const JointTablePath& table, JointFaults& faults) {
  const SceneJointLaw& law = table.law;
  if (!law.maximum_closure) return;
  if (!law.normal_stiffness && table.paths.size() == 1)
    faults.report(
        table, {"maximum_closure"},
        "maximum_closure without normal_stiffness, a number is needed: the stiffness of the joint before "
        "it closes");
  need_area_springs(scene, table, "maximum_closure", faults);
  constexpr const char* reason =
      "a joint that stiffens as it closes has neither bonds nor crushing: leave one of the two out";
  exclude(table, law.tensile_strength > 0.0, {"tensile_strength", "tied", "maximum_closure"}, reason, faults);
  exclude(table, law.compressive_strength.has_value(), {"compressive_strength", "tied", "maximum_closure"},
          reason, faults);
  exclude(table, law.fracture_energy.has_value(), {"fracture_energy", "tied", "maximum_closure"}, reason,
          faults);
}

/// The rules of a law, which a key gives.
struct LawRules {
  const char* key;
  void (*check)(const Scene&, const JointTablePath&, JointFaults&);
};
constexpr std::array laws = {LawRules{"compressive_strength", check_crushing},
                             LawRules{"roughness", check_roughness},
                             LawRules{"maximum_closure", check_closure}};

/// An analysis without joints that crush.
void check_analysis_of_crushing(const Scene& scene, Diagnostics& diagnostics) {
  const bool moves = !scene.analysis.movement.supports.empty();
  if (!moves && scene.analysis.type != SceneAnalysis::Type::pushover) return;
  if (const auto first = first_given(scene, "compressive_strength"))
    diagnostics.error(scene.places.key(*first),
                      fmt::format("compressive_strength in {}, where joints do not crush; leave it out",
                                  moves ? "a movement of supports" : "a pushover"));
}

}  // namespace

void check_joint_rules(const Scene& scene, Diagnostics& diagnostics) {
  const auto is_given = [&](const LawRules& of) { return first_given(scene, of.key).has_value(); };
  if (std::none_of(laws.begin(), laws.end(), is_given)) return;
  JointFaults faults(scene, diagnostics);
  const std::vector<JointTablePath> tables = tables_of_joints(scene);
  for (const LawRules& of : laws)
    for (const JointTablePath& table : tables)
      if (!table.law.tied) of.check(scene, table, faults);
  check_analysis_of_crushing(scene, diagnostics);
}

}  // namespace ashlar

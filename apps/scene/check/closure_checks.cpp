#include "apps/scene/check/closure_checks.hpp"

#include <fmt/format.h>

#include "apps/scene/check/joint_tables.hpp"

namespace ashlar {
namespace {

void check_closure(const Scene& scene, const JointTablePath& table, JointFaults& faults) {
  const SceneJointLaw& law = table.law;
  if (!law.maximum_closure || law.tied) return;
  if (!law.normal_stiffness && table.paths.size() == 1)
    faults.report(
        table, {"maximum_closure"},
        "maximum_closure without normal_stiffness, a number is needed: the stiffness of the joint before "
        "it closes");
  if (scene.contact.springs != SceneContact::Springs::area)
    faults.report(table, {"maximum_closure"},
                  "maximum_closure with point springs, which have no pressure; springs = \"area\" is needed");
  const auto exclude = [&](const char* key, bool has) {
    if (has)
      faults.report(
          table, {key, "tied", "maximum_closure"},
          fmt::format("{} beside maximum_closure; a joint that stiffens as it closes has neither bonds nor "
                      "crushing: leave one of the two out",
                      key));
  };
  exclude("tensile_strength", law.tensile_strength > 0.0);
  exclude("compressive_strength", law.compressive_strength.has_value());
  exclude("fracture_energy", law.fracture_energy.has_value());
}

}  // namespace

void check_closures(const Scene& scene, Diagnostics& diagnostics) {
  if (!first_given(scene, "maximum_closure")) return;
  JointFaults faults(scene, diagnostics);
  for (const JointTablePath& table : tables_of_joints(scene)) check_closure(scene, table, faults);
}

}  // namespace ashlar

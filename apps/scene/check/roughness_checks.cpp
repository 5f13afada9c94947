#include "apps/scene/check/roughness_checks.hpp"

#include <fmt/format.h>

#include "apps/scene/check/joint_tables.hpp"

namespace ashlar {
namespace {

void check_roughness_of(const Scene& scene, const JointTablePath& table, JointFaults& faults) {
  const SceneJointLaw& law = table.law;
  if (!law.roughness || law.tied) return;
  const auto exclude = [&](const char* key, bool has) {
    if (has)
      faults.report(
          table, {key, "roughness"},
          fmt::format(
              "{} beside roughness; a rough joint has the strength of its roughness, of friction_angle "
              "and cohesion: leave one of the two out",
              key));
  };
  exclude("friction_angle_residual", law.friction_angle_residual.has_value());
  exclude("compressive_strength", law.compressive_strength.has_value());
  exclude("fracture_energy", law.fracture_energy.has_value());
  if (scene.contact.springs != SceneContact::Springs::area)
    faults.report(table, {"roughness"},
                  "roughness with point springs, which have no pressure; springs = \"area\" is needed");
}

}  // namespace

void check_roughness(const Scene& scene, Diagnostics& diagnostics) {
  if (!first_given(scene, "roughness")) return;
  JointFaults faults(scene, diagnostics);
  for (const JointTablePath& table : tables_of_joints(scene)) check_roughness_of(scene, table, faults);
}

}  // namespace ashlar

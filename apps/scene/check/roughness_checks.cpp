#include "apps/scene/check/roughness_checks.hpp"

#include <fmt/format.h>

#include "apps/scene/check/joint_tables.hpp"

namespace ashlar {
namespace {

void check_table(const Scene& scene, const JointTablePath& table, Diagnostics& diagnostics) {
  const SceneJointLaw& law = table.law;
  if (!law.roughness || law.tied) return;
  const auto exclude = [&](const std::string& key, bool has) {
    if (!has) return;
    for (const std::string& place : {table.path + "." + key, table.path + ".roughness"}) {
      if (!scene.places.contains(place)) continue;
      diagnostics.error(
          scene.places.key(place),
          fmt::format(
              "{} beside roughness; a rough joint has the strength of its roughness, of friction_angle "
              "and cohesion: leave one of the two out",
              key));
      return;
    }
  };
  exclude("friction_angle_residual", law.friction_angle_residual.has_value());
  exclude("compressive_strength", law.compressive_strength.has_value());
  exclude("fracture_energy", law.fracture_energy.has_value());
}

}  // namespace

void check_roughness(const Scene& scene, Diagnostics& diagnostics) {
  for (const JointTablePath& table : tables_of_joints(scene)) {
    check_table(scene, table, diagnostics);
    const std::string key = table.path + ".roughness";
    if (scene.contact.springs == SceneContact::Springs::area || !scene.places.contains(key)) continue;
    diagnostics.error(scene.places.key(key),
                      "roughness with point springs, which have no pressure; springs = \"area\" is needed");
  }
}

}  // namespace ashlar

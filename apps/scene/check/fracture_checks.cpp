#include "apps/scene/check/fracture_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/model/cut_rock.hpp"
#include "apps/scene/model/joint_table.hpp"

namespace ashlar {
namespace {

/// Faults of one law.
class FractureFaults {
 public:
  FractureFaults(const Scene& scene, const std::string& path, Diagnostics& diagnostics)
      : scene_(scene), path_(path), diagnostics_(diagnostics) {}

  void check_strength(const char* part, double energy, const char* key, double strength) {
    if (energy > 0.0 && !(strength > 0.0))
      report({fmt::format("fracture_energy.{}", part), "fracture_energy"},
             fmt::format("fracture_energy.{} without {} ({} J/m^2), a {} > 0 is needed", part, key, energy,
                         key));
    if (strength > 0.0 && !(energy > 0.0))
      report({"fracture_energy", key},
             fmt::format("fracture_energy.{} is missing ({} is {} Pa), each strength needs its energy", part,
                         key, strength));
  }

  /// @param stiffness empty: automatic, and stiff enough
  void check_stiffness(const char* key, const std::optional<double>& stiffness, double strength,
                       double energy) {
    if (!stiffness || !(energy > 0.0)) return;
    const double least = least_bond_stiffness(strength, energy);
    if (*stiffness > least) return;
    report({key, "fracture_energy"},
           fmt::format(
               "{} is too small for the fracture energy ({} Pa/m), its springs hold more than that at the "
               "strength; more than {:.6g} Pa/m is needed",
               key, *stiffness, least));
  }

  void exclude(const char* key, bool is_given) {
    if (!is_given) return;
    report(
        {key, "fracture_energy"},
        fmt::format("{} beside fracture_energy (both given), a joint that softens has friction, cohesion and "
                    "tensile strength alone",
                    key));
  }

  void check_springs() {
    if (scene_.contact.springs == SceneContact::Springs::area) return;
    report({"fracture_energy", "tied"},
           "point springs (springs = \"point\", or formulation = \"paper\") with a bond per area, springs "
           "per area are needed");
  }

 private:
  /// Reports at the first of these keys that the table gives.
  void report(const std::vector<std::string>& keys, const std::string& message) {
    for (const std::string& key : keys) {
      const std::string place = fmt::format("{}.{}", path_, key);
      if (scene_.places.contains(place)) return diagnostics_.error(scene_.places.key(place), message);
    }
    diagnostics_.error(scene_.places.key(path_), message);
  }

  const Scene& scene_;
  std::string path_;
  Diagnostics& diagnostics_;
};

bool is_of_bond(const SceneJoint& joint) {
  return joint.made_by_cut && joint.tie;
}

/// Keys of a [[joint]] on which the checks depend.
constexpr std::array fracture_keys = {"fracture_energy",   "tied",
                                      "cohesion",          "tensile_strength",
                                      "cohesion_residual", "normal_stiffness",
                                      "dilation_angle",    "damping",
                                      "shear_stiffness",   "friction_angle_residual",
                                      "friction_angle",    "tensile_strength_residual"};

}  // namespace

void check_fracture(const Scene& scene, const SceneJointLaw& law, const std::string& path,
                    Diagnostics& diagnostics) {
  FractureFaults faults(scene, path, diagnostics);
  if (law.tie || law.fracture_energy) faults.check_springs();
  if (!law.fracture_energy) return;
  const auto& [tension, shear] = *law.fracture_energy;
  faults.check_strength("tension", tension, "tensile_strength", law.tensile_strength);
  faults.check_strength("shear", shear, "cohesion", law.cohesion);
  faults.check_stiffness("normal_stiffness", law.normal_stiffness, law.tensile_strength, tension);
  faults.check_stiffness("shear_stiffness", law.shear_stiffness, law.cohesion, shear);
  faults.exclude("cohesion_residual", law.cohesion_residual.value_or(0.0) > 0.0);
  faults.exclude("tensile_strength_residual", law.tensile_strength_residual.value_or(0.0) > 0.0);
  faults.exclude("friction_angle_residual",
                 law.friction_angle_residual.value_or(law.friction_angle) < law.friction_angle);
  faults.exclude("dilation_angle", law.dilation_angle > 0.0);
  faults.exclude("damping", law.damping > 0.0);
}

void check_joint_fracture(const Scene& scene, std::size_t joint, Diagnostics& diagnostics) {
  const std::string path = fmt::format("joint.{}", joint);
  const bool has_own_tie = scene.joint[joint].tie && !is_of_bond(scene.joint[joint]);
  const auto given = [&](const char* key) { return scene.places.contains(fmt::format("{}.{}", path, key)); };
  if (std::none_of(fracture_keys.begin(), fracture_keys.end(), given)) return;
  for (const char* key : {"cohesion", "tensile_strength"}) {
    if (has_own_tie && given(key))
      diagnostics.error(
          scene.places.key(fmt::format("{}.{}", path, key)),
          fmt::format("{} beside the strength of a tie (both given), only one of both is allowed", key));
  }
  const SceneJointLaw law = law_with_joint(scene, joint);
  if (!law.tied) check_fracture(scene, law, path, diagnostics);
}

SceneJointLaw law_with_joint(const Scene& scene, std::size_t joint) {
  SceneJointLaw law = scene.contact.law;
  const SceneJoint& last = scene.joint[joint];
  bool bonded = is_of_bond(last);
  for (std::size_t k = 0; k < joint; ++k) {
    if (!is_of_bond(scene.joint[k]) || scene.joint[k].cut != last.cut) continue;
    override_law(law, scene.joint[k]);
    bonded = true;
  }
  override_law(law, last);
  // Of a brittle bond, in place of that of [contact].
  if (bonded && law.fracture_energy && !law.fracture_energy->given()) law.fracture_energy.reset();
  return law;
}

void check_bonded_blocks(const Scene& scene, Diagnostics& diagnostics) {
  if (!scene.rock || std::none_of(scene.cut.begin(), scene.cut.end(),
                                  [](const SceneCut& cut) { return cut.bonded.has_value(); }))
    return;
  const JointTable table(scene);
  std::set<std::size_t> reported;
  for (const auto& [pair, cuts] : scene.rock->common) {
    const auto bond = std::find_if(cuts.begin(), cuts.end(),
                                   [&](std::size_t cut) { return scene.cut[cut].bonded.has_value(); });
    if (bond == cuts.end()) continue;
    for (const std::size_t k : table.joints_between(pair.first, pair.second)) {
      const SceneJoint& joint = scene.joint[k];
      if (is_of_bond(joint) || !(joint.tied || joint.tie) || !reported.insert(k).second) continue;
      diagnostics.error(
          scene.places.key(fmt::format("joint.{}.tied", k)),
          fmt::format("{} beside bonded of cut \"{}\" (both between blocks \"{}\" and \"{}\"), only one of "
                      "both is allowed",
                      joint.made_by_cut ? "glued" : "tied", scene.cut[*bond].name,
                      scene.block[pair.first].name, scene.block[pair.second].name));
    }
  }
}

}  // namespace ashlar

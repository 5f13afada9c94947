#include "apps/scene/model/scene.hpp"

#include <algorithm>

#include "apps/scene/model/name_pattern.hpp"

namespace ashlar {

void override_law(SceneJointLaw& law, const SceneJoint& joint) {
  // A stiffness that is given anew has the curve given with it, or none.
  if (joint.normal_stiffness) {
    law.normal_stiffness = *joint.normal_stiffness;
    law.maximum_closure.reset();
  }
  law.shear_stiffness = joint.shear_stiffness.value_or(law.shear_stiffness);
  law.friction_angle = joint.friction_angle.value_or(law.friction_angle);
  law.cohesion = joint.cohesion.value_or(law.cohesion);
  law.tensile_strength = joint.tensile_strength.value_or(law.tensile_strength);
  const auto replace = [](std::optional<double>& value, const std::optional<double>& given) {
    if (given) value = given;
  };
  replace(law.maximum_closure, joint.maximum_closure);
  replace(law.compressive_strength, joint.compressive_strength);
  replace(law.friction_angle_residual, joint.friction_angle_residual);
  replace(law.cohesion_residual, joint.cohesion_residual);
  replace(law.tensile_strength_residual, joint.tensile_strength_residual);
  law.dilation_angle = joint.dilation_angle.value_or(law.dilation_angle);
  law.damping = joint.damping.value_or(law.damping);
  if (joint.restitution) law.restitution = joint.restitution;
  if (joint.roughness) law.roughness = joint.roughness;
  if (joint.fracture_energy) law.fracture_energy = joint.fracture_energy;
  if (!joint.tied && !joint.tie) return;
  law.tied = joint.tied.value_or(false);
  law.tie = joint.tie;
  if (!law.tie) return;
  law.cohesion = law.tie->shear;
  law.tensile_strength = law.tie->tension;
  law.cohesion_residual = law.tensile_strength_residual = std::nullopt;
}

SceneJointLaw joint_law_between(const Scene& scene, const std::string& block_a, const std::string& block_b) {
  SceneJointLaw law = scene.contact.law;
  for (const SceneJoint& joint : scene.joint) {
    if (joint.cut.empty() && !joint.inside && pattern_matches_pair(joint.blocks, block_a, block_b))
      override_law(law, joint);
  }
  return law;
}

const char* history_key(const SceneFix& fix) {
  switch (fix.record) {
    case MotionRecord::displacement:
    case MotionRecord::smooth_displacement:
      return "displacement_history";
    case MotionRecord::velocity:
      return "velocity_history";
    case MotionRecord::acceleration:
      return "acceleration_history";
  }
  return "displacement_history";
}

bool is_static(const SceneAnalysis& analysis) {
  return analysis.type != SceneAnalysis::Type::dynamic;
}

bool starts_from_statics(const Scene& scene) {
  return scene.analysis.type == SceneAnalysis::Type::dynamic &&
         scene.analysis.initial_state == SceneAnalysis::InitialState::statics;
}

bool has_multipliers(const Scene& scene) {
  if (scene.contact.augmented) return *scene.contact.augmented;
  const bool given = scene.contact.law.gives_stiffness();
  const auto any_joint = [&](const auto& is_so) {
    const auto is_one = [&](const SceneJoint& joint) {
      return !joint.made_by_cut && (is_so(joint.normal_stiffness) || is_so(joint.shear_stiffness));
    };
    return std::any_of(scene.joint.begin(), scene.joint.end(), is_one) ||
           std::any_of(scene.stage.begin(), scene.stage.end(), [&](const SceneStage& stage) {
             return std::any_of(stage.joint.begin(), stage.joint.end(), is_one);
           });
  };
  const auto counted = std::count_if(scene.stage.begin(), scene.stage.end(),
                                     [](const SceneStage& stage) { return is_static(stage.analysis); });
  const auto statics = static_cast<std::size_t>(counted);
  const bool only_statics = scene.stage.empty() ? is_static(scene.analysis) : statics == scene.stage.size();
  using Stiffness = std::optional<std::optional<double>>;
  if (only_statics)
    return !given || any_joint([](const Stiffness& stiffness) { return stiffness && !*stiffness; });
  return (starts_from_statics(scene) || statics > 0) && !given &&
         !any_joint([](const Stiffness& stiffness) { return stiffness && *stiffness; });
}

const SceneMaterial* find_material(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.material.begin(), scene.material.end(),
                                  [&](const SceneMaterial& material) { return material.name == name; });
  return found == scene.material.end() ? nullptr : &*found;
}

}  // namespace ashlar

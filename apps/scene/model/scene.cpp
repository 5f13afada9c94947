#include "apps/scene/model/scene.hpp"

#include <algorithm>

#include "apps/scene/model/name_pattern.hpp"

namespace ashlar {

void override_law(SceneJointLaw& law, const SceneJoint& joint) {
  // A member that is added to the law does not compile until it is named, and given, here.
  auto& [normal_stiffness, shear_stiffness, maximum_closure, friction_angle, cohesion, tensile_strength,
         compressive_strength, friction_angle_residual, cohesion_residual, tensile_strength_residual,
         dilation_angle, damping, restitution, fracture_energy, roughness, tied, tie] = law;
  const auto replace = [](auto& value, const auto& given) {
    if (given) value = *given;
  };
  // A stiffness that is given anew has the curve given with it, or none.
  if (joint.normal_stiffness) maximum_closure.reset();
  replace(normal_stiffness, joint.normal_stiffness);
  replace(shear_stiffness, joint.shear_stiffness);
  replace(maximum_closure, joint.maximum_closure);
  replace(friction_angle, joint.friction_angle);
  replace(cohesion, joint.cohesion);
  replace(tensile_strength, joint.tensile_strength);
  replace(compressive_strength, joint.compressive_strength);
  replace(friction_angle_residual, joint.friction_angle_residual);
  replace(cohesion_residual, joint.cohesion_residual);
  replace(tensile_strength_residual, joint.tensile_strength_residual);
  replace(dilation_angle, joint.dilation_angle);
  replace(damping, joint.damping);
  replace(restitution, joint.restitution);
  replace(fracture_energy, joint.fracture_energy);
  replace(roughness, joint.roughness);
  if (!joint.tied && !joint.tie) return;
  tied = joint.tied.value_or(false);
  tie = joint.tie;
  if (!tie) return;
  cohesion = tie->shear;
  tensile_strength = tie->tension;
  cohesion_residual = tensile_strength_residual = std::nullopt;
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

#include "apps/scene/check/warnings/idle_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "apps/scene/keys/joint_law_keys.hpp"

namespace ashlar {
namespace {

class IdleKeys {
 public:
  IdleKeys(const Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  /// Warns if the key was given. @param path as in ScenePlaces. @param reason for the missing effect
  void warn(const std::string& path, const std::string& reason) {
    if (!scene_.places.contains(path)) return;
    diagnostics_.warning(scene_.places.key(path),
                         fmt::format("{} has no effect: {}", path.substr(path.rfind('.') + 1), reason));
  }

 private:
  const Scene& scene_;
  Diagnostics& diagnostics_;
};

void warn_of_analysis(const Scene& scene, IdleKeys& keys) {
  const SceneAnalysis& analysis = scene.analysis;
  if (is_static(analysis)) {
    for (const char* key : {"analysis.integrator", "analysis.spectral_radius", "analysis.mass_damping",
                            "analysis.stiffness_damping", "analysis.sleeping"})
      keys.warn(key, "a static analysis has no motion in time");
    if (analysis.initial_state == SceneAnalysis::InitialState::statics)
      keys.warn("analysis.initial_state", "a static analysis starts from where blocks are placed");
  } else if (analysis.integrator != SceneAnalysis::Integrator::generalized_alpha) {
    keys.warn("analysis.spectral_radius", "only integrator = \"generalized-alpha\" has one");
  }
  if (analysis.type != SceneAnalysis::Type::safety)
    keys.warn("analysis.safety", "only type = \"factor-of-safety\" looks for one");
  if (analysis.type != SceneAnalysis::Type::capacity)
    keys.warn("analysis.capacity", "only type = \"capacity\" looks for one");
  if (analysis.type != SceneAnalysis::Type::thrust)
    keys.warn("analysis.movement", "only type = \"thrust\" looks for one");
  if (analysis.type != SceneAnalysis::Type::pushover) {
    keys.warn("analysis.pushover", "only type = \"pushover\" has one");
    keys.warn("analysis.spectrum", "only type = \"pushover\" is compared with one");
  }
  if (analysis.type != SceneAnalysis::Type::safety && analysis.type != SceneAnalysis::Type::capacity)
    keys.warn("analysis.method", "only a search for a factor has one");
  if (!analysis.gravity_history.empty()) keys.warn("analysis.gravity", "gravity_history is in its place");
  if (!has_multipliers(scene)) keys.warn("contact.penetration_tolerance", "it is that of augmented = true");
}

/// A key may apply to many blocks, of a file or an array: it has an effect if one of them deforms.
void warn_of_orders(const Scene& scene, IdleKeys& keys) {
  const auto path = [](std::size_t k) { return fmt::format("block.{}.order", k); };
  std::set<std::string> in_effect;  // by place
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    if (!scene.block[k].fixed && scene.places.contains(path(k)))
      in_effect.insert(to_string(scene.places.key(path(k))));
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    if (scene.block[k].fixed && !in_effect.contains(to_string(scene.places.key(path(k)))))
      keys.warn(path(k), "a fixed block does not deform");
}

void warn_of_blocks(const Scene& scene, IdleKeys& keys) {
  for (std::size_t k = 0; k < scene.block.size(); ++k) {
    const SceneBlock& block = scene.block[k];
    const auto path = [&](const char* key) { return fmt::format("block.{}.{}", k, key); };
    if (is_static(scene.analysis) && !block.velocity.isZero(0.0))
      keys.warn(path("velocity"), "a static analysis has no motion in time");
    if (is_static(scene.analysis) && !block.angular_velocity.isZero(0.0))
      keys.warn(path("angular_velocity"), "a static analysis has no motion in time");
  }
}

void warn_of_restitution(const Scene& scene, IdleKeys& keys) {
  if (!is_static(scene.analysis)) return;
  constexpr const char* reason = "a static analysis has no motion in time";
  keys.warn("contact.restitution", reason);
  for (std::size_t k = 0; k < scene.joint.size(); ++k)
    keys.warn(fmt::format("joint.{}.restitution", k), reason);
}

/// Only springs have dashpots, and only in dynamics.
void warn_of_joint_damping(const Scene& scene, IdleKeys& keys) {
  const bool asked = scene.contact.augmented.value_or(false);
  const auto check = [&](const std::string& path, const SceneJointLaw& law, bool keeps_springs) {
    if (law.damping == 0.0) return;
    const std::string key = path + ".damping";
    if (is_static(scene.analysis))
      keys.warn(key, "a static analysis has no motion in time");
    else if (has_multipliers(scene) && !keeps_springs)
      keys.warn(
          key,
          asked ? "multipliers hold joints here, and only springs are damped: augmented = false has springs"
                : "multipliers hold this joint, and only springs are damped: normal_stiffness gives it some");
  };
  bool any = scene.contact.law.keeps_springs(asked);
  for (std::size_t k = 0; k < scene.joint.size(); ++k) {
    SceneJointLaw law = scene.contact.law;
    override_law(law, scene.joint[k]);
    any = any || law.keeps_springs(asked);
    check(fmt::format("joint.{}", k), law, law.keeps_springs(asked));
  }
  check("contact", scene.contact.law, any);
}

/// Warns of joints that tie two blocks by their names. Globs may also match pairs untied by a later joint.
void warn_of_ties(const Scene& scene, IdleKeys& keys) {
  for (std::size_t k = 0; k < scene.joint.size(); ++k) {
    const SceneJoint& joint = scene.joint[k];
    const auto is_glob = [](const std::string& name) {
      return name.find_first_of("*?[") != std::string::npos;
    };
    if (!joint.tied.value_or(false) || is_glob(joint.blocks[0]) || is_glob(joint.blocks[1])) continue;
    for (const std::string& key : keys::joint_law_keys())
      keys.warn(fmt::format("joint.{}.{}", k, key), "tied blocks neither open nor slide");
  }
}

}  // namespace

void warn_of_idle_keys(const Scene& scene, Diagnostics& diagnostics) {
  IdleKeys keys(scene, diagnostics);
  warn_of_analysis(scene, keys);
  warn_of_orders(scene, keys);
  warn_of_blocks(scene, keys);
  warn_of_ties(scene, keys);
  warn_of_joint_damping(scene, keys);
  warn_of_restitution(scene, keys);
}

}  // namespace ashlar

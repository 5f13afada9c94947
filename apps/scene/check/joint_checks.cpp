#include "apps/scene/check/joint_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "apps/scene/check/fracture_checks.hpp"

namespace ashlar {
namespace {

/// Keys of joints with a residual value.
constexpr std::array strength_keys = {"friction_angle", "cohesion", "tensile_strength"};

/// Reports a residual strength above that of an intact joint. @param path of the table with the last of both
void check_residuals(const Scene& scene, const SceneJointLaw& law, const std::string& path,
                     Diagnostics& diagnostics) {
  const auto check = [&](const char* key, double strength, const std::optional<double>& residual,
                         const char* unit) {
    if (!residual || *residual <= strength) return;
    const std::string name = fmt::format("{}_residual", key);
    const bool given = scene.places.contains(fmt::format("{}.{}", path, name));
    diagnostics.error(scene.places.value(fmt::format("{}.{}", path, given ? name : key)),
                      fmt::format("{} is above {} ({} {}), at most {} {} is allowed", name, key, *residual,
                                  unit, strength, unit));
  };
  check("friction_angle", law.friction_angle, law.friction_angle_residual, "degrees");
  check("cohesion", law.cohesion, law.cohesion_residual, "Pa");
  check("tensile_strength", law.tensile_strength, law.tensile_strength_residual, "Pa");
}

/// Reports dilation above friction: such a joint would do more work than sliding dissipates.
/// @param path of the table with the last of both
void check_dilation(const Scene& scene, const SceneJointLaw& law, const std::string& path,
                    Diagnostics& diagnostics) {
  const bool weakens = law.friction_angle_residual && *law.friction_angle_residual < law.friction_angle;
  const double most = weakens ? *law.friction_angle_residual : law.friction_angle;
  if (law.dilation_angle <= most) return;
  const char* bound = weakens ? "friction_angle_residual" : "friction_angle";
  const bool given = scene.places.contains(fmt::format("{}.dilation_angle", path));
  // A table that gives neither would repeat a fault of [contact].
  if (!given && !scene.places.contains(fmt::format("{}.{}", path, bound))) return;
  diagnostics.error(scene.places.value(fmt::format("{}.{}", path, given ? "dilation_angle" : bound)),
                    fmt::format("dilation_angle is above {} ({} degrees), at most {} degrees is allowed",
                                bound, law.dilation_angle, most));
}

}  // namespace

void check_joint_laws(const Scene& scene, Diagnostics& diagnostics) {
  check_residuals(scene, scene.contact.law, "contact", diagnostics);
  check_dilation(scene, scene.contact.law, "contact", diagnostics);
  check_fracture(scene, scene.contact.law, "contact", diagnostics);
  for (std::size_t i = 0; i < scene.joint.size(); ++i) {
    const std::string path = fmt::format("joint.{}", i);
    check_joint_fracture(scene, i, diagnostics);
    const bool given = std::any_of(strength_keys.begin(), strength_keys.end(), [&](const char* key) {
      return scene.places.contains(fmt::format("{}.{}", path, key)) ||
             scene.places.contains(fmt::format("{}.{}_residual", path, key));
    });
    if (!given && !scene.places.contains(path + ".dilation_angle")) continue;
    const SceneJointLaw law = law_with_joint(scene, i);
    check_residuals(scene, law, path, diagnostics);
    check_dilation(scene, law, path, diagnostics);
  }
  check_bonded_blocks(scene, diagnostics);
}

}  // namespace ashlar

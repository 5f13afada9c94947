#include "apps/scene/check/warnings/implausible_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

void warn_of_small_angle(const Scene& scene, const std::string& key, double angle, Diagnostics& diagnostics) {
  if (!(angle > 0.0 && angle < 1.0)) return;
  diagnostics.warning(
      scene.places.value(key),
      fmt::format("friction_angle is in degrees ({}): tan({} deg) = {:.2g}; a coefficient of "
                  "{} is {:.3g} degrees, {} rad "
                  "are {:.3g} degrees",
                  angle, angle, correctly_rounded::tan_of_degrees(angle), angle,
                  correctly_rounded::degrees_of_atan(angle), angle, angle * 180.0 / std::numbers::pi));
}

void warn_of_no_friction(const Scene& scene, Diagnostics& diagnostics) {
  const bool said = scene.places.contains("contact.friction_angle") ||
                    std::any_of(scene.joint.begin(), scene.joint.end(), [](const SceneJoint& joint) {
                      return joint.friction_angle.has_value() || joint.tied.value_or(false);
                    });
  const auto moving = std::count_if(scene.block.begin(), scene.block.end(),
                                    [](const SceneBlock& block) { return !block.fixed; });
  if (said || moving == 0 || scene.block.size() < 2) return;
  diagnostics.warning(
      scene.places.key("contact.friction_angle"),
      "no friction anywhere (friction_angle is given neither in [contact] nor in a [[joint]]): blocks on "
      "slopes and in arches slide; friction_angle = 0 says that this is meant");
}

/// Ties are springs without stress of their own.
void warn_of_ties_under_stress(const Scene& scene, Diagnostics& diagnostics) {
  const bool ties = std::any_of(scene.joint.begin(), scene.joint.end(),
                                [](const SceneJoint& joint) { return joint.tied.value_or(false); });
  if (!scene.initial_stress.given() || !ties || is_static(scene.analysis) ||
      scene.analysis.initial_state == SceneAnalysis::InitialState::statics)
    return;
  diagnostics.warning(scene.places.key("initial_stress"),
                      "ties begin without the stress of the ground: blocks move until ties have taken it up; "
                      "initial_state = \"static\" brings them to rest first");
}

/// For a history, its first row.
void warn_of_upward_gravity(const Scene& scene, Diagnostics& diagnostics) {
  const SceneAnalysis& analysis = scene.analysis;
  const bool changes = !analysis.gravity_history.empty();
  const Vector3& gravity = changes ? analysis.gravity_history.front().value : analysis.gravity;
  if (!(gravity.z() > correctly_rounded::hypot(gravity.x(), gravity.y()))) return;
  diagnostics.warning(
      scene.places.value(changes ? "analysis.gravity_history" : "analysis.gravity"),
      fmt::format("gravity points upwards ([{}, {}, {}]): z is up, [0, 0, -9.81] is the earth's", gravity.x(),
                  gravity.y(), gravity.z()));
}

double width_of(const Polyhedron& solid) {
  const Box box = box_of(solid.mesh().points);
  return (box.high - box.low).maxCoeff();
}

}  // namespace

void warn_of_implausible_keys(const ExpandedScene& scene, Diagnostics& diagnostics) {
  warn_of_small_angle(scene, "contact.friction_angle", scene.contact.law.friction_angle, diagnostics);
  for (std::size_t k = 0; k < scene.joint.size(); ++k)
    warn_of_small_angle(scene, fmt::format("joint.{}.friction_angle", k),
                        scene.joint[k].friction_angle.value_or(0.0), diagnostics);
  warn_of_no_friction(scene, diagnostics);
  warn_of_upward_gravity(scene, diagnostics);
  warn_of_ties_under_stress(scene, diagnostics);
}

void warn_of_mesh_units(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                        Diagnostics& diagnostics) {
  const auto without_scale = [&](std::size_t k) {
    return std::holds_alternative<SceneMesh>(scene.block[k].shape) &&
           !scene.places.contains(fmt::format("block.{}.mesh.scale", k));
  };
  double widest = 0.0;
  for (std::size_t k = 0; k < solids.size(); ++k)
    if (solids[k] && !without_scale(k)) widest = std::max(widest, width_of(*solids[k]));
  if (widest == 0.0) return;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (!solids[k] || !without_scale(k)) continue;
    const double width = width_of(*solids[k]);
    if (!(width >= mesh_in_millimetres * widest)) continue;
    diagnostics.warning(
        scene.places.key(fmt::format("block.{}.mesh", k)),
        fmt::format("block \"{}\" is {:.3g} m wide, {:.2g} times the widest of the blocks that are no such "
                    "meshes: a mesh in millimetres needs mesh.scale = 1e-3",
                    scene.block[k].name, width, width / widest));
  }
}

}  // namespace ashlar

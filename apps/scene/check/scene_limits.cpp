#include "apps/scene/check/scene_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/check/initial_overlap.hpp"
#include "apps/scene/model/support_history.hpp"
#include "geometry/exact/rounded_functions.hpp"
#include "solver/settings.hpp"

namespace ashlar {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

double farthest_coordinate(const std::vector<std::optional<Polyhedron>>& solids) {
  double farthest = 0.0;
  for (const std::optional<Polyhedron>& solid : solids) {
    for (std::size_t n = 0; solid && n < solid->mesh().points.size(); ++n)
      farthest = std::max(farthest, solid->mesh().points[n].cwiseAbs().maxCoeff());
  }
  return farthest;
}

void check_length(const char* name, const std::optional<double>& length, double least, const Scene& scene,
                  Diagnostics& diagnostics) {
  if (!length || *length >= least) return;
  diagnostics.error(scene.places.value(fmt::format("contact.{}", name)),
                    fmt::format("{} is less than coordinates are rounded to ({:.4g} m), at least {:.4g} m "
                                "is needed",
                                name, *length, least));
}

/// Masses and moments of inertia are proportional to up to the fifth power of lengths. @return true if the size is
/// valid
bool check_size(const Scene& scene, std::size_t k, const Polyhedron& solid, Diagnostics& diagnostics) {
  constexpr double least = 1e-50, most = 1e50;
  double extent = 0.0;
  const Vector3& first = solid.mesh().points.front();
  for (const Vector3& point : solid.mesh().points)
    extent = std::max(extent, (point - first).cwiseAbs().maxCoeff());
  const double size = correctly_rounded::cbrt(solid.volume());
  if (size >= least && extent <= most) return true;
  diagnostics.error(
      scene.places.key(fmt::format("block.{}", k)),
      fmt::format("block \"{}\" is {} for double precision ({:.4g} m wide, volume {:.4g} m^3), {:g} to "
                  "{:g} m is allowed",
                  scene.block[k].name, extent > most ? "too large" : "too small", extent, solid.volume(),
                  least, most));
  return false;
}

void check_speeds(const Scene& scene, std::size_t k, double size, Diagnostics& diagnostics) {
  const double steps = std::ldexp(1.0, SimulationSettings{}.max_step_cuts);
  const SceneBlock& block = scene.block[k];
  const auto check = [&](const char* name, const Vector3& given, double most, const char* unit) {
    const double speed = given.stableNorm();
    if (!(speed > most)) return;
    diagnostics.error(scene.places.value(fmt::format("block.{}.{}", k, name)),
                      fmt::format("{} is too large for this time_step ({:.4g} {}), at most {:.4g} {} is "
                                  "allowed",
                                  name, speed, unit, most, unit));
  };
  if (is_static(scene.analysis) || !(scene.analysis.time_step > 0.0)) return;
  check("velocity", block.velocity, steps * size / scene.analysis.time_step, "m/s");
  check("angular_velocity", block.angular_velocity, steps / scene.analysis.time_step, "rad/s");
}

void check_histories(const Scene& scene, std::size_t k, double size, Diagnostics& diagnostics) {
  const double most = allowed_initial_overlap * size / rounding;
  for (std::size_t n = 0; n < scene.block[k].fix.size(); ++n) {
    const SceneFix& fix = scene.block[k].fix[n];
    if (fix.history.empty()) continue;
    const double farthest = RecordedMotion(support_history(fix)).farthest_until(scene.analysis.end_time);
    if (farthest <= most) continue;
    diagnostics.error(scene.places.value(fmt::format("block.{}.fix.{}.{}", k, n, history_key(fix))),
                      fmt::format("{} moves the block beyond the range of double precision "
                                  "({:.4g} m), at most {:.4g} m is allowed",
                                  history_key(fix), farthest, most));
  }
}

}  // namespace

void check_limits(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                  Diagnostics& diagnostics) {
  const double least = rounding * farthest_coordinate(solids);
  check_length("distance", scene.contact.distance, least, scene, diagnostics);
  check_length("penetration_tolerance", scene.contact.penetration_tolerance, least, scene, diagnostics);
  check_length("allowed_depth", scene.contact.allowed_depth, least, scene, diagnostics);
  const double shortest = rounding * scene.analysis.end_time;
  if (scene.analysis.time_step > 0.0 && scene.analysis.time_step < shortest)
    diagnostics.error(scene.places.value("analysis.time_step"),
                      fmt::format("time_step is less than times are rounded to ({:.4g} s), at least {:.4g} s "
                                  "is needed for this end_time",
                                  scene.analysis.time_step, shortest));
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (!solids[k]) continue;
    const double size = correctly_rounded::cbrt(solids[k]->volume());
    if (!check_size(scene, k, *solids[k], diagnostics)) continue;
    check_speeds(scene, k, size, diagnostics);
    check_histories(scene, k, size, diagnostics);
  }
}

}  // namespace ashlar

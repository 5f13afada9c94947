#include "apps/results/columns/summary_units.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <string_view>
#include <utility>

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

struct Quantity {
  std::string_view path;  ///< of "x.*" all keys below
  std::string_view unit;  ///< "1": a number without one
};

/// Of a factor of safety or of loads, and of its limit analysis.
constexpr Quantity of_factor[] = {
    {"lower", "1"},
    {"upper", "1"},
    {"released", "1"},
    {"associated", "1"},
    {"associated_bracket", "1"},
    {"gap", "1"},
    {"onset", "1"},
    {"onset_displacement", "m"},
    {"displacement", "m"},
    {"allowed_displacement", "m"},
    {"accelerations", "m/s^2"},
    {"angular_accelerations", "rad/s^2"},
    {"associated_motion.accelerations", "m/s^2"},
    {"associated_motion.angular_accelerations", "rad/s^2"},
    {"bolts.axial_force", "N"},
    {"bolts.shear_force", "N"},
    {"least_strength.value", "Pa"},
    {"trials.*", "1"},
    {"path_trials.*", "1"},
};
constexpr std::string_view factors[] = {"factor_of_safety.limit.", "factor_of_safety.", "load_factor.limit.",
                                        "load_factor."};

/// Of a movement of a support, out or in.
constexpr Quantity of_movement[] = {
    {"lower", "m"},       {"upper", "m"},        {"farthest", "m"},
    {"thrust", "m, N"},   {"joints.place", "m"}, {"joints.rotation", "degrees"},
    {"joints.slip", "m"},
};
constexpr std::string_view movements[] = {"thrust.movement.out.", "thrust.movement.in."};

constexpr Quantity of_run[] = {
    {"time", "s"},
    {"steps", "1"},
    {"blocks", "1"},
    {"unknowns", "1"},
    {"frames", "1"},
    {"counts.*", "1"},
    {"wall_seconds.*", "s"},
    {"peak_memory_bytes", "bytes"},
    {"penetration_max", "m"},
    {"contact_depth_max", "m"},
    {"deepest.value", "m"},
    {"deepest.of_smaller_block", "1"},
    {"deepest.time", "s"},
    {"deepest.place", "m"},
    {"known_overlaps.depth", "m"},
    {"largest_displacement.value", "m"},
    {"largest_displacement.place", "m"},
    {"largest_compression.value", "Pa"},
    {"largest_compression.place", "m"},
    {"largest_tension.value", "Pa"},
    {"largest_tension.place", "m"},
    {"largest_strain.value", "1"},
    {"largest_strain.place", "m"},
    {"broken.pairs", "1"},
    {"broken.area", "m^2"},
    {"broken.of_area", "1"},
    {"support.largest_tension.force", "N"},
    {"support.largest_compression.force", "N"},
    {"support.largest_shear.force", "N"},
    {"support.bolts.axial_force", "N"},
    {"support.bolts.shear_force", "N"},
    {"support.states.*", "1"},
    {"sliding_friction.*", "N s"},
    {"dilating_slip.*", "m^3"},
    {"most_closed.of_maximum", "1"},
    {"most_closed.time", "s"},
    {"impacts.count", "1"},
    {"impacts.inaccurate", "1"},
    {"impacts.unlike_restitution", "1"},
    {"impacts.largest_residual", "1"},
    {"impacts.largest_residual_time", "s"},
    {"energy_redetection.gained", "J"},
    {"energy_redetection.lost", "J"},
    {"energy_residual", "J"},
    {"energy_residual_of_a_step_max", "J"},
    {"energy_max", "J"},
    {"error.estimate", "1"},
    {"error.by.*", "1"},
    {"error.blocks.order", "1"},
    {"error.blocks.estimate", "1"},
    {"error.blocks_estimated", "1"},
    {"error.blocks_in_all", "1"},
    {"error.measures.*", "1"},
    {"error.accuracy", "1"},
    {"error.orders.*", "1"},
    {"error.skipped", "1"},
    {"error.analyses", "1"},
    {"error.steps_tested", "1"},
    {"error.steps_with_impacts", "1"},
    {"error.error_of_impacts", "1"},
    {"error.step_bounded_by.step", "s"},
    {"error.step_bounded_by.count", "1"},
    {"error.step_bounded_by.others", "1"},
    {"rejected_steps.count", "1"},
    {"rejected_steps.reasons.*", "1"},
    {"rejected_steps.first.time", "s"},
    {"rejected_steps.first.step", "s"},
    {"moving.acceleration", "m/s^2"},
    {"moving.angular_acceleration", "rad/s^2"},
    {"displaced.distance", "m"},
    {"verdict.moving", "1"},
    {"verdict.displaced", "1"},
    {"verdict.speed", "m/s"},
    {"verdict.fallen.distance", "m"},
    {"verdict.fallen.drop", "m"},
    {"verdict.fallen.runout", "m"},
    {"verdict.fallen.time", "s"},
    {"stages.steps", "1"},
    {"stages.time", "s"},
    {"states.step", "1"},
    {"origin", "m"},
    {"rank_imbalance", "1"},
    {"repartitions", "1"},
    {"ranks.wall_seconds.*", "s"},
    {"ranks.processor_seconds.*", "s"},
    {"ranks.for_results.wall_seconds", "s"},
    {"ranks.peak_memory_bytes", "bytes"},
    {"ranks.bytes_sent", "bytes"},
    {"ranks.for_results.bytes_sent", "bytes"},
    {"ranks.for_results.collective_calls", "1"},
    {"ranks.for_results.messages_sent", "1"},
    {"ranks.blocks", "1"},
    {"ranks.ghosts", "1"},
    {"ranks.ghost_searches", "1"},
    {"ranks.weight", "1"},
    {"ranks.pairs", "1"},
    {"ranks.border_pairs", "1"},
    {"ranks.unknowns", "1"},
    {"ranks.contact_points", "1"},
    {"ranks.shared_systems.*", "1"},
    {"ranks.collective_calls", "1"},
    {"ranks.messages_sent", "1"},
    {"thrust.least", "N"},
    {"thrust.most", "N"},
    {"thrust.gap", "1"},
    {"thrust.least_line.place", "m"},
    {"thrust.least_line.force", "N"},
    {"thrust.most_line.place", "m"},
    {"thrust.most_line.force", "N"},
    {"thrust.least_bolts.axial_force", "N"},
    {"thrust.least_bolts.shear_force", "N"},
    {"thrust.most_bolts.axial_force", "N"},
    {"thrust.most_bolts.shear_force", "N"},
    {"thrust.movement.direction", "1"},
    {"thrust.movement.support", "1"},
    {"states.displacement", "m"},
    {"states.multiplier", "1"},
    {"pushover.direction", "1"},
    {"pushover.multiplier", "1"},
    {"pushover.displacement", "m"},
    {"pushover.curve", "m, 1"},
    {"pushover.mechanisms.displacement", "m"},
    {"pushover.directions.direction", "1"},
    {"pushover.directions.multiplier", "1"},
    {"pushover.directions.displacement", "m"},
    {"pushover.directions.a0_star", "m/s^2"},
    {"kinematic.alpha0", "1"},
    {"kinematic.weight", "N"},
    {"kinematic.mass", "kg"},
    {"kinematic.mass_fraction", "1"},
    {"kinematic.confidence_factor", "1"},
    {"kinematic.a0_star", "m/s^2"},
    {"kinematic.d0", "m"},
    {"kinematic.d0_star", "m"},
    {"kinematic.du_star", "m"},
    {"kinematic.ds_star", "m"},
    {"kinematic.as_star", "m/s^2"},
    {"kinematic.period_secant", "s"},
    {"kinematic.demand.behaviour_factor", "1"},
    {"kinematic.demand.ground_acceleration", "m/s^2"},
    {"kinematic.demand.building_period", "s"},
    {"kinematic.demand.psi", "1"},
    {"kinematic.demand.gamma", "1"},
    {"kinematic.demand.linear.ratio", "1"},
    {"kinematic.demand.linear_at_height.ratio", "1"},
    {"kinematic.demand.nonlinear.ratio", "1"},
    {"kinematic.demand.nonlinear_at_height.ratio", "1"},
    {"kinematic.demand.linear.*", "m/s^2"},
    {"kinematic.demand.linear_at_height.*", "m/s^2"},
    {"kinematic.demand.nonlinear.*", "m"},
    {"kinematic.demand.nonlinear_at_height.*", "m"},
};

/// The unit of a path among declared ones; empty: it is not declared.
std::string_view unit_among(const Quantity* first, const Quantity* last, std::string_view path) {
  const Quantity* found = std::find_if(first, last, [path](const Quantity& declared) {
    if (!declared.path.ends_with('*')) return declared.path == path;
    return path.starts_with(declared.path.substr(0, declared.path.size() - 1));
  });
  return found == last ? std::string_view() : found->unit;
}

std::string_view declared_unit(std::string_view path) {
  for (const std::string_view prefix : factors)
    if (path.starts_with(prefix))
      if (const auto unit =
              unit_among(std::begin(of_factor), std::end(of_factor), path.substr(prefix.size()));
          !unit.empty())
        return unit;
  for (const std::string_view prefix : movements)
    if (path.starts_with(prefix))
      return unit_among(std::begin(of_movement), std::end(of_movement), path.substr(prefix.size()));
  return unit_among(std::begin(of_run), std::end(of_run), path);
}

/// Calls `visit` with the path of each number.
void visit_numbers(const Json& value, const std::string& path,
                   const std::function<void(const std::string&)>& visit) {
  constexpr std::array others = {"scene", "automatic", "peaks", "versions", "identity", "units"};
  if (value.is_number()) visit(path);
  if (value.is_array())
    for (const Json& entry : value) visit_numbers(entry, path, visit);
  if (!value.is_object()) return;
  for (const auto& [key, entry] : value.items())
    if (!path.empty() || std::find(others.begin(), others.end(), key) == others.end())
      visit_numbers(entry, path.empty() ? key : path + "." + key, visit);
}

}  // namespace

Json summary_units(const Json& summary) {
  Json units = Json::object();
  visit_numbers(summary, "", [&](const std::string& path) {
    const std::string_view unit = declared_unit(path);
    if (!unit.empty() && unit != "1") units[path] = unit;
  });
  return units;
}

std::vector<std::string> undeclared_numbers(const Json& summary) {
  std::set<std::string> paths;
  visit_numbers(summary, "", [&](const std::string& path) {
    if (declared_unit(path).empty()) paths.insert(path);
  });
  return {paths.begin(), paths.end()};
}

}  // namespace ashlar

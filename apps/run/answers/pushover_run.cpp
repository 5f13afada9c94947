#include "apps/run/answers/pushover_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/run/answers/block_name.hpp"
#include "apps/scene/assemble/limit_choices.hpp"
#include "apps/scene/model/block_names.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "geometry/exact/axis_rotation.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// The measure that a pushover controls; null: there is none of that name, or it is of no block.
const SceneMeasure* measure_of_control(const Scene& scene) {
  for (const SceneMeasure& measure : scene.measure)
    if (measure.name == scene.analysis.pushover.control) return measure.block.empty() ? nullptr : &measure;
  return nullptr;
}

std::optional<PushoverControl> control_of(const Scene& scene, const Simulation& simulation) {
  if (scene.analysis.pushover.control.empty()) return std::nullopt;
  const SceneMeasure* measure = measure_of_control(scene);
  if (measure == nullptr) return std::nullopt;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.name() == measure->block)
      return PushoverControl{static_cast<int>(k), measure->point.value_or(block.basis().centroid())};
  }
  return std::nullopt;
}

/// Diagonal of the box around all blocks that may move, m.
double size_of_blocks(const Simulation& simulation) {
  Eigen::AlignedBox3d box;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.fixed() || !simulation.system().present(static_cast<int>(k))) continue;
    const PlacedBlock placed(block, simulation.states()[k].position);
    for (const Vector3& point : block.solid().mesh().points) box.extend(placed.place(point));
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

/// Unit vectors: that of the scene, or several at equal angles about gravity, beginning with it.
std::vector<Vector3> directions_of(const Scene& scene, const Vector3& gravity) {
  const ScenePushover& asked = scene.analysis.pushover;
  if (!asked.directions) return {asked.direction.value_or(Vector3(Vector3::UnitX())).normalized()};
  const Vector3 up = -gravity.normalized();
  const auto level = [&up](const Vector3& vector) { return Vector3(vector - vector.dot(up) * up); };
  constexpr double upright = 1e-6;
  Vector3 first = level(asked.direction.value_or(Vector3(Vector3::UnitX())).normalized());
  if (first.norm() < upright) first = up.unitOrthogonal();
  std::vector<Vector3> directions;
  for (int k = 0; k < *asked.directions; ++k)
    directions.emplace_back(rotation_matrix(up, degree_turn(360.0 * k / *asked.directions)) *
                            first.normalized());
  return directions;
}

PushoverSearch search_along(const Scene& scene, const Simulation& simulation, const Vector3& direction,
                            const std::function<bool()>& may_continue) {
  const ScenePushover& asked = scene.analysis.pushover;
  PushoverSearch search;
  search.direction = direction;
  search.limit = asked.limit.value_or(size_of_blocks(simulation));
  search.control = control_of(scene, simulation);
  search.shares = shares_of_check();
  search.may_continue = may_continue;
  if (!asked.blocks.empty()) search.multiplied = pushed_by_loads(scene);
  return search;
}

/// "zero after 0.125 m"
std::string end_of_push(const Pushover& path) {
  const double last = path.places.empty() ? 0.0 : path.places.back().displacement;
  const double multiplier = path.places.empty() ? 0.0 : path.places.back().multiplier;
  switch (path.end) {
    case PushoverEnd::zero:
      return fmt::format("zero after {:.5g} m", path.zero.value_or(last));
    case PushoverEnd::reaches_limit:
      return fmt::format("still {:.5g} after {:.5g} m, as far as was tried", multiplier, last);
    case PushoverEnd::collapses:
      return fmt::format("{:.5g} after {:.5g} m, where a block loses its support", multiplier, last);
    case PushoverEnd::jams:
      return fmt::format("{:.5g} after {:.5g} m, where nothing moves the blocks on", multiplier, last);
    case PushoverEnd::immovable:
      return "no multiplier moves a block";
    case PushoverEnd::not_balanced:
      return "the blocks do not stand without the push, with friction alone";
    case PushoverEnd::control_at_rest:
      return fmt::format("{:.5g} after {:.5g} m, where the control does not move along the direction",
                         multiplier, last);
    case PushoverEnd::not_determined:
      return fmt::format("{:.5g} after {:.5g} m, not determined beyond", multiplier, last);
    case PushoverEnd::interrupted:
      return "interrupted";
  }
  return "";
}

Json vector_json(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

Json names_json(const std::vector<int>& blocks, const Simulation& simulation) {
  Json json = Json::array();
  for (const int block : blocks) json.push_back(block_name(simulation, block));
  return json;
}

Json first_multiplier(const Pushover& path) {
  return path.places.empty() ? Json(nullptr) : Json(path.activation);
}

Json zero_json(const Pushover& path) {
  return path.zero ? Json(*path.zero) : Json(nullptr);
}

/// The direction with the least multiplier; one without a mechanism only if there is no other.
std::size_t weakest_of(const std::vector<PushedDirection>& directions) {
  std::size_t weakest = 0;
  const auto multiplier = [&](std::size_t k) {
    const Pushover& path = directions[k].path;
    return path.places.empty() ? std::numeric_limits<double>::infinity() : path.activation;
  };
  for (std::size_t k = 1; k < directions.size(); ++k)
    if (multiplier(k) < multiplier(weakest)) weakest = k;
  return weakest;
}

Json or_null_value(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json verdict_json_of(const std::optional<KinematicVerdict>& verdict) {
  if (!verdict) return nullptr;
  return {{"capacity", verdict->capacity},
          {"demand", verdict->demand},
          {"ratio", verdict->demand > 0.0 ? Json(verdict->capacity / verdict->demand) : Json(nullptr)},
          {"satisfied", verdict->satisfied()}};
}

}  // namespace

void refuse_pushover(const Scene& scene, const std::optional<RigidModel>& model, Diagnostics& diagnostics) {
  const SceneAnalysis& analysis = scene.analysis;
  if (analysis.type != SceneAnalysis::Type::pushover || !model || model->bodies.empty()) return;
  const std::string& control = analysis.pushover.control;
  if (!control.empty() && measure_of_control(scene) == nullptr) {
    std::vector<std::string> names;
    for (const SceneMeasure& measure : scene.measure)
      if (!measure.block.empty()) names.push_back(measure.name);
    diagnostics.error(scene.places.value("analysis.pushover.control"),
                      fmt::format("control of a pushover is no measure of a point or a block (\"{}\"), {}the "
                                  "name of a [[measure]] with a block is needed",
                                  control, guess(control, names, "\"")));
  }
  if (const auto held = block_held_in_part(*model))
    diagnostics.error(scene.places.key("analysis.pushover"),
                      fmt::format("block {} is held in part by [[block.fix]] and cannot be followed where it "
                                  "turns, blocks that are fixed or free are needed",
                                  scene.block[at(*held)].name));
  if (!(analysis.gravity.norm() > 0.0) && analysis.gravity_history.empty())
    diagnostics.error(scene.places.key("analysis.gravity"),
                      "a pushover has no gravity (0 m/s^2), forces in proportion to weights are needed");
  if (!analysis.pushover.blocks.empty() && !multiplies_loads(*model))
    diagnostics.error(scene.places.value("analysis.pushover.blocks"),
                      "loads to multiply move no block (0 N in all), one that can move a block is needed");
}

PushoverFindings find_pushover(const Scene& scene, const Simulation& simulation, int threads,
                               const std::function<bool()>& may_continue) {
  const double end_time = scene.analysis.end_time;
  const Vector3 gravity = simulation.system().settings().gravity_at(end_time);
  const PlacedScene placed{simulation.system(), simulation.states(), simulation.histories(), end_time,
                           threads};
  PushoverFindings findings;
  for (const Vector3& direction : directions_of(scene, gravity)) {
    PushedDirection pushed;
    pushed.direction = direction;
    pushed.path = pushover(placed, search_along(scene, simulation, direction, may_continue));
    if (scene.analysis.pushover.blocks.empty())
      pushed.check =
          kinematic_check(pushed.path, scene.analysis.pushover, scene.analysis.spectrum, gravity.norm());
    findings.directions.push_back(std::move(pushed));
    if (findings.directions.back().path.end == PushoverEnd::interrupted) break;
  }
  findings.weakest = static_cast<int>(weakest_of(findings.directions));
  return findings;
}

bool is_known(const PushoverFindings& findings) {
  switch (findings.weakest_direction().path.end) {
    case PushoverEnd::zero:
    case PushoverEnd::reaches_limit:
    case PushoverEnd::collapses:
    case PushoverEnd::jams:
    case PushoverEnd::immovable:
      return true;
    case PushoverEnd::not_balanced:
    case PushoverEnd::control_at_rest:
    case PushoverEnd::not_determined:
    case PushoverEnd::interrupted:
      break;
  }
  return false;
}

std::string describe(const PushoverFindings& findings, const Simulation& simulation) {
  const PushedDirection& weakest = findings.weakest_direction();
  const Pushover& path = weakest.path;
  if (path.places.empty()) return end_of_push(path);
  std::string text;
  if (findings.directions.size() > 1)
    text = fmt::format("weakest of {} directions [{:.4g}, {:.4g}, {:.4g}]: ", findings.directions.size(),
                       weakest.direction.x(), weakest.direction.y(), weakest.direction.z());
  const std::vector<int>& moving = path.places.front().moving;
  const std::string blocks = moving.size() == 1
                                 ? fmt::format("block {} moves", block_name(simulation, moving.front()))
                                 : fmt::format("{} blocks move", moving.size());
  const std::string alone = path.left_out_strength ? ", by friction alone" : "";
  if (path.at_limit)
    text += fmt::format("multiplier {:.5g}, {} ({}{})", path.activation, end_of_push(path), blocks, alone);
  else
    text += fmt::format("multiplier {:.5g}{}; if joints dilate {:.5g}, {} ({})", path.activation, alone,
                        path.places.front().multiplier, end_of_push(path), blocks);
  if (!weakest.check) return text;
  const KinematicCapacity& capacity = weakest.check->capacity;
  text += fmt::format("; a0* {:.4g} m/s^2", capacity.acceleration);
  if (capacity.ultimate) text += fmt::format(", d_u* {:.4g} m", *capacity.ultimate);
  if (weakest.check->demand) text += fmt::format(", check {}", verdict_of(*weakest.check));
  return text;
}

Json pushover_summary(const PushoverFindings& findings, const Simulation& simulation) {
  const PushedDirection& weakest = findings.weakest_direction();
  const Pushover& path = weakest.path;
  Json json = {{"direction", vector_json(weakest.direction)}, {"status", to_string(path.end)}};
  json["multiplier"] = first_multiplier(path);
  json["at_limit"] = path.at_limit;
  json["displacement"] = zero_json(path);
  json["curve"] = Json::array();
  json["mechanisms"] = Json::array();
  const std::vector<int>* moving = nullptr;
  for (const PushoverPlace& place : path.places) {
    json["curve"].push_back({place.displacement, place.multiplier});
    if (moving != nullptr && *moving == place.moving) continue;
    moving = &place.moving;
    json["mechanisms"].push_back(
        {{"displacement", place.displacement}, {"moving", names_json(place.moving, simulation)}});
  }
  if (findings.directions.size() < 2) return json;
  json["directions"] = Json::array();
  for (const PushedDirection& pushed : findings.directions) {
    Json one = {{"direction", vector_json(pushed.direction)}, {"status", to_string(pushed.path.end)}};
    one["multiplier"] = first_multiplier(pushed.path);
    one["displacement"] = zero_json(pushed.path);
    one["a0_star"] = pushed.check ? Json(pushed.check->capacity.acceleration) : Json(nullptr);
    json["directions"].push_back(std::move(one));
  }
  return json;
}

Json kinematic_summary(const KinematicCheck& check) {
  const KinematicCapacity& capacity = check.capacity;
  Json json = {{"alpha0", capacity.multiplier},
               {"weight", capacity.weight},
               {"mass", capacity.mass},
               {"mass_fraction", capacity.mass_fraction},
               {"confidence_factor", check.confidence_factor},
               {"a0_star", capacity.acceleration},
               {"d0", or_null_value(capacity.zero)}};
  json["d0_star"] = capacity.zero ? Json(*capacity.zero * capacity.displacement_ratio) : Json(nullptr);
  json["du_star"] = or_null_value(capacity.ultimate);
  json["ds_star"] = or_null_value(capacity.secant);
  json["as_star"] = or_null_value(capacity.secant_acceleration);
  json["period_secant"] = or_null_value(capacity.secant_period);
  json["demand"] = nullptr;
  if (check.demand) {
    const KinematicDemand& demand = *check.demand;
    json["demand"] = {{"behaviour_factor", check.behaviour_factor},
                      {"ground_acceleration", demand.ground_acceleration},
                      {"linear", verdict_json_of(demand.linear)},
                      {"nonlinear", verdict_json_of(demand.nonlinear)}};
    if (demand.linear_above) {
      json["demand"]["building_period"] = demand.building_period;
      json["demand"]["psi"] = demand.mode;
      json["demand"]["gamma"] = demand.participation;
      json["demand"]["linear_at_height"] = verdict_json_of(demand.linear_above);
      json["demand"]["nonlinear_at_height"] = verdict_json_of(demand.nonlinear_above);
    }
  }
  json["verdict"] = verdict_of(check);
  return json;
}

std::vector<ShownState> pushover_states(const PushoverFindings& findings) {
  std::vector<ShownState> states;
  const Pushover& path = findings.weakest_direction().path;
  for (const PushoverState& state : path.states) {
    const PushoverPlace& place = path.places[at(state.place)];
    states.push_back({fmt::format("multiplier {:.4g} at {:.4g} m", place.multiplier, place.displacement),
                      state.positions,
                      {state.contacts, {}}});
  }
  return states;
}

}  // namespace ashlar

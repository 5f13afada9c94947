#include "apps/run/answers/movement_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "apps/results/text/atomic_file.hpp"
#include "apps/run/answers/block_name.hpp"
#include "apps/run/answers/drawing_view.hpp"
#include "apps/scene/model/block_names.hpp"
#include "geometry/index.hpp"
#include "solver/paths/yielding_support.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

bool asks_for_movements(const Scene& scene) {
  return scene.analysis.type == SceneAnalysis::Type::thrust && !scene.analysis.movement.supports.empty();
}

/// "collapses at 0.1411 m"
std::string end_in_words(const SupportPath& path) {
  switch (path.end) {
    case MovementEnd::collapses:
      return fmt::format("collapses at {:.5g} m", path.upper.value_or(path.lower));
    case MovementEnd::jams:
      return fmt::format("jams at {:.5g} m", path.upper.value_or(path.lower));
    case MovementEnd::reaches_limit:
      return "not limited as far as was tried";
    case MovementEnd::not_balanced:
      return "no equilibrium with friction alone where it begins";
    case MovementEnd::not_determined:
      return "not determined beyond";
    case MovementEnd::interrupted:
      return "interrupted";
  }
  return "";
}

/// Joints are named if they have slid by more than this, m.
double telling_slip(const SupportPath& path) {
  constexpr double share = 0.01;  // of the movement
  return share * path.lower;
}

std::string slip_in_words(const SupportPath& path) {
  double most = 0.0;
  for (const MovedJoint& joint : path.joints) most = std::max(most, joint.slip);
  if (!(most > telling_slip(path))) return "";
  const std::string others =
      path.farthest ? fmt::format("; up to {:.5g} m if they slide in another order", *path.farthest) : "";
  return fmt::format(", joints slide by up to {:.3g} m{}", most, others);
}

Json to_json(const SupportPath& path, const Simulation& simulation) {
  Json json = {{"lower", path.lower}};
  json["upper"] = path.upper ? Json(*path.upper) : Json(nullptr);
  json["farthest"] = path.farthest ? Json(*path.farthest) : Json(nullptr);
  json["status"] = to_string(path.end);
  json["thrust"] = Json::array();
  for (const MovedPlace& place : path.places) json["thrust"].push_back({place.moved, place.thrust});
  json["joints"] = Json::array();
  for (const MovedJoint& joint : path.joints)
    json["joints"].push_back(
        {{"blocks", Json{block_name(simulation, joint.blocks[0]), block_name(simulation, joint.blocks[1])}},
         {"place", Json{joint.place.x(), joint.place.y(), joint.place.z()}},
         {"rotation", joint.rotation * 180.0 / std::numbers::pi},
         {"slip", joint.slip},
         {"pressed", joint.pressed_on}});
  json["moving"] = Json::array();
  for (const int block : path.moving) json["moving"].push_back(block_name(simulation, block));
  return json;
}

}  // namespace

std::vector<int> moved_supports(const Scene& scene, const RigidModel& model) {
  std::vector<int> supports;
  if (!asks_for_movements(scene)) return supports;
  const std::vector<std::string>& patterns = scene.analysis.movement.supports;
  for (const int support : supports_of(model))
    if (std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
          return pattern_names_block(scene, pattern, at(support));
        }))
      supports.push_back(support);
  return supports;
}

void refuse_movements(const Scene& scene, const std::optional<RigidModel>& model, Diagnostics& diagnostics) {
  if (!asks_for_movements(scene) || !model || model->bodies.empty()) return;
  const std::vector<int> supports = supports_of(*model);
  for (const std::string& pattern : scene.analysis.movement.supports)
    if (std::none_of(supports.begin(), supports.end(),
                     [&](int support) { return pattern_names_block(scene, pattern, at(support)); }))
      diagnostics.error(
          scene.places.value("analysis.movement.supports"),
          fmt::format("movement names no support (\"{}\"), the name of a block that does not move and that "
                      "one bears on which does, or a glob that matches one, is needed",
                      pattern));
  if (const auto held = block_held_in_part(*model))
    diagnostics.error(scene.places.key("analysis.movement"),
                      fmt::format("block {} is held in part by [[block.fix]] and cannot be followed where it "
                                  "turns, blocks that are fixed or free are needed",
                                  scene.block[at(*held)].name));
  if (!is_loaded(*model))
    diagnostics.error(scene.places.key("analysis.movement"),
                      "no load acts (0 N in all), gravity or loads that press on supports are needed");
}

SupportMovement find_movement(const Scene& scene, const RigidModel& model, const Simulation& simulation,
                              const MovementRequest& request) {
  constexpr double limit = 0.5, tolerance = 1e-4;  // of the structure's size
  const SceneAnalysis::SupportSearch& asked = scene.analysis.movement;
  const double size = extent_of(model);
  const MovementSearch search{asked.direction, asked.limit.value_or(limit * size),
                              asked.tolerance.value_or(tolerance * size), request.may_continue};
  return support_movement({simulation.system(), simulation.states(), simulation.histories(),
                           scene.analysis.end_time, request.threads},
                          request.support, search);
}

std::pair<const char*, const char*> senses_in_words(const SupportMovement& movement) {
  if (movement.away) return {"out", "in"};
  if (movement.direction) return {"along its direction", "against it"};
  return {"apart", "together"};
}

std::string describe(const SupportMovement& movement, const Simulation& simulation) {
  const auto path_in_words = [](const SupportPath& path, const char* sense) {
    return fmt::format("{:.5g} m {} ({}{})", path.lower, sense, end_in_words(path), slip_in_words(path));
  };
  const auto [out, in] = senses_in_words(movement);
  return fmt::format("{} can move {}, {}{}", block_name(simulation, movement.support),
                     path_in_words(movement.out, out), path_in_words(movement.in, in),
                     movement.left_out_strength ? ", by friction alone" : "");
}

Json movement_summary(const SupportMovement& movement, const Simulation& simulation) {
  Json json;
  const auto& direction = movement.direction;
  json["direction"] = direction ? Json{direction->x(), direction->y(), direction->z()} : Json(nullptr);
  json["out"] = to_json(movement.out, simulation);
  json["in"] = to_json(movement.in, simulation);
  return json;
}

void draw_movement(const std::vector<SupportMovement>& movements, const Scene& scene,
                   const Simulation& simulation, const std::filesystem::path& path) {
  if (movements.empty()) return;
  const SupportMovement& movement = movements.front();
  const SupportPath& out = movement.out;
  const DrawingView view(scene, simulation, [&](int block, const Vector3& point) {
    return PlacedBlock(simulation.blocks()[at(block)], out.positions[at(block)]).place(point);
  });
  std::string text = view.head() + view.blocks(simulation);
  for (const MovedJoint& joint : out.joints) {
    if (!joint.pressed_on) continue;
    const std::string place = view.at(joint.place);
    const std::size_t comma = place.find(',');
    text += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"#b3261e\"/>\n", place.substr(0, comma),
                        place.substr(comma + 1));
  }
  const std::vector<DrawingView::Note> notes = {
      {"#333333", fmt::format("support moved by {:.4g} m, {}", out.lower, end_in_words(out))},
      {"#b3261e", "joints that have turned or slid"}};
  write_file_atomically(path, text + view.foot(notes), Durability::process);
}

}  // namespace ashlar

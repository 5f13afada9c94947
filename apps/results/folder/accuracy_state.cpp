#include "apps/results/folder/accuracy_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/index.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

/// Number of moving blocks of each order.
Json orders_of(const Simulation& simulation) {
  std::map<int, int> counts;
  for (const BlockModel& block : simulation.blocks())
    if (!block.fixed()) ++counts[block.rigid() ? 0 : block.order()];
  Json json = Json::object();
  for (const auto& [order, count] : counts) json[std::to_string(order)] = count;
  return json;
}

}  // namespace

double AccuracyState::estimate() const {
  return (goals.empty() ? order_error + sub_face_error : *std::max_element(goals.begin(), goals.end())) +
         motion.error + motion.noise;
}

std::string accuracy_advice(const Scene& scene, const Simulation& simulation, const AccuracyState& state) {
  if (!(state.estimate() > *scene.analysis.accuracy)) return {};
  const double by_step = state.motion.error + state.motion.noise;
  if (by_step > state.order_error && by_step > state.sub_face_error)
    return "the motion has impacts or vibrations that no larger step resolves: a larger accuracy, or a given "
           "time_step, is needed";
  if (state.sub_face_error > state.order_error)
    return "contact of curved faces needs more sub-faces than are chosen: a smaller contact.chord_tolerance "
           "is "
           "needed";
  if (state.slow_block >= 0) {
    const BlockModel& block = simulation.blocks()[at(state.slow_block)];
    return fmt::format(
        "a higher order of block {} (now {}) helps little: its stress is concentrated at {}; several tied "
        "blocks, "
        "small ones there, are needed in its place",
        block.name(), block.order(),
        block.supported() ? "its supports or at a corner" : "a corner or a small contact");
  }
  return "blocks whose order is given, or which have their highest order, limit it: higher orders, or "
         "smaller tied "
         "blocks, are needed";
}

nlohmann::ordered_json accuracy_summary(const Scene& scene, const Simulation& simulation,
                                        const AccuracyState& state) {
  Json by = {{"order", state.order_error}, {"sub_faces", state.sub_face_error}};
  if (scene.analysis.automatic_step) by["step"] = state.motion.error + state.motion.noise;
  Json json = {{"accuracy", *scene.analysis.accuracy}, {"estimate", state.estimate()}, {"by", std::move(by)}};
  Json measures = Json::object();
  for (std::size_t k = 0; k < state.goals.size(); ++k)
    measures[scene.measure[k].name] = state.goals[k] + state.motion.error + state.motion.noise;
  json["measures"] = std::move(measures);
  json["orders"] = orders_of(simulation);
  json["analyses"] = state.rounds;
  if (scene.analysis.automatic_step) {
    json["steps_tested"] = state.motion.tests;
    json["steps_with_impacts"] = state.motion.impacts;
    json["error_of_impacts"] = state.motion.impact_error;
  }
  json["advice"] = accuracy_advice(scene, simulation, state);
  return json;
}

}  // namespace ashlar

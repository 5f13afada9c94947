#include "apps/results/folder/error_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/index.hpp"
#include "solver/accuracy/chosen_orders.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

std::vector<OrderError> worst_first(std::vector<OrderError> errors) {
  std::stable_sort(errors.begin(), errors.end(), [](const OrderError& a, const OrderError& b) {
    return a.missing_energy > b.missing_energy;
  });
  return errors;
}

/// Number of moving blocks of each order.
Json orders_of(const Simulation& simulation) {
  std::map<int, int> counts;
  for (const BlockModel& block : simulation.blocks())
    if (!block.fixed()) ++counts[block.rigid() ? 0 : block.order()];
  Json json = Json::object();
  for (const auto& [order, count] : counts) json[std::to_string(order)] = count;
  return json;
}

/// Blocks whose chosen order is below the largest chosen one: they did not need it.
int left_low(const Simulation& simulation, const AccuracyState& state) {
  int largest = 0, count = 0;
  for (const auto& [block, order] : state.orders)
    if (!simulation.blocks()[at(block)].rigid()) largest = std::max(largest, order);
  for (const auto& [block, order] : state.orders)
    if (!simulation.blocks()[at(block)].rigid() && order < largest) ++count;
  return count;
}

/// Of a choice that ended early.
std::string left_at_highest_order(const AccuracyState& state) {
  return state.out_of_reach > 0.0
             ? fmt::format(" (order {} would leave about {:.1g})", largest_chosen_order, state.out_of_reach)
             : "";
}

/// Names of the first ones.
std::vector<std::string> first_names(const Simulation& simulation, const std::vector<int>& blocks) {
  constexpr std::size_t most = 10;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(blocks.size(), most); ++k)
    names.push_back(simulation.blocks()[at(blocks[k])].name());
  return names;
}

/// To end a sentence; empty: unknown.
std::string bound_of_step(const Simulation& simulation, const BoundingIsland& bounding) {
  if (bounding.blocks.empty()) return {};
  const std::vector<std::string> names = first_names(simulation, bounding.blocks);
  const std::string others =
      bounding.gain > 0.0 ? fmt::format(", others would allow {:.2g} times the step", bounding.gain) : "";
  return fmt::format("; the step is bounded by {} {}{}{}", names.size() == 1 ? "block" : "blocks",
                     fmt::join(names, ", "), names.size() < bounding.blocks.size() ? ", ..." : "", others);
}

}  // namespace

nlohmann::ordered_json error_summary(const Simulation& simulation, const OrderErrors& errors) {
  constexpr std::size_t most = 10;
  Json blocks = Json::array();
  for (const OrderError& error : worst_first(errors.errors)) {
    if (error.missing_energy == 0.0 || blocks.size() == most) break;
    const BlockModel& block = simulation.blocks()[at(error.block)];
    blocks.push_back({{"block", block.name()}, {"order", block.order()}, {"estimate", error.relative()}});
  }
  Json json = Json::object();
  if (!errors.errors.empty()) {
    const double estimate = relative_error(errors.errors);
    json["estimate"] = estimate;
    json["by"] = {{"order", estimate}};
  }
  json["blocks"] = std::move(blocks);
  json["blocks_estimated"] = errors.errors.size();
  json["blocks_in_all"] = errors.blocks;
  return json;
}

void add_measure_errors(const Scene& scene, const std::vector<GoalError>& errors,
                        nlohmann::ordered_json& summary) {
  Json measures = Json::object();
  for (std::size_t k = 0; k < errors.size(); ++k) measures[scene.measure[k].name] = errors[k].relative;
  summary["measures"] = std::move(measures);
}

std::optional<OrderError> coarse_block(const Simulation& simulation, const std::vector<OrderError>& errors) {
  std::vector<OrderError> raised;
  for (const OrderError& error : errors)
    if (simulation.blocks()[at(error.block)].order() > 1) raised.push_back(error);
  if (!(relative_error(raised) > ordinary_order_error)) return std::nullopt;
  return worst_first(std::move(raised)).front();
}

std::string accuracy_advice(const Scene& scene, const Simulation& simulation, const AccuracyState& state) {
  if (!(state.estimate() > *scene.analysis.accuracy)) return {};
  const double by_step = state.motion.error + state.motion.noise;
  if (by_step > state.order_error && by_step > state.sub_face_error)
    return "steps do not resolve its impacts or vibrations: a larger accuracy, or a given time_step, is "
           "needed" +
           bound_of_step(simulation, state.motion.bounding);
  if (state.sub_face_error > state.order_error)
    return "curved faces in contact need more sub-faces: a smaller contact.chord_tolerance is needed";
  if (state.slow_block >= 0) {
    const BlockModel& block = simulation.blocks()[at(state.slow_block)];
    return fmt::format(
        "a higher order of block {} (now {}) helps little{}, its stress is concentrated at {}: several tied "
        "blocks, "
        "small ones there, are needed",
        block.name(), block.order(), left_at_highest_order(state),
        block.supported() ? "its supports or at a corner" : "a corner or a small contact");
  }
  if (state.out_of_reach > 0.0)
    return fmt::format(
        "higher orders help little{}, stresses are concentrated at clamps, corners or small "
        "contacts: several tied blocks, small ones there, are needed",
        left_at_highest_order(state));
  return "given or highest orders of blocks limit it: higher orders, or smaller tied blocks, are needed";
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
  json["skipped"] = left_low(simulation, state);
  json["analyses"] = state.rounds;
  if (scene.analysis.automatic_step) {
    json["steps_tested"] = state.motion.tests;
    json["steps_with_impacts"] = state.motion.impacts;
    json["error_of_impacts"] = state.motion.impact_error;
    if (const BoundingIsland& bounding = state.motion.bounding; !bounding.blocks.empty())
      json["step_bounded_by"] = {{"step", state.motion.shortest_step},
                                 {"blocks", first_names(simulation, bounding.blocks)},
                                 {"count", bounding.blocks.size()},
                                 {"others", bounding.gain}};
  }
  json["advice"] = accuracy_advice(scene, simulation, state);
  return json;
}

}  // namespace ashlar

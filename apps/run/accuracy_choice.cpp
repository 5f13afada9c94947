#include "apps/run/accuracy_choice.hpp"

#include <algorithm>
#include <limits>

#include "apps/results/tables/measure_goals.hpp"
#include "apps/run/run_setup.hpp"
#include "apps/scene/assemble/initial_state.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

AccuracyRequest request_of(const Scene& scene) {
  AccuracyRequest request{.accuracy = *scene.analysis.accuracy,
                          .orders = {},
                          .sub_faces = !scene.contact.chord_tolerance && !scene.contact.subdivisions};
  for (const SceneBlock& block : scene.block) request.orders.push_back(block.automatic_order && !block.fixed);
  return request;
}

void take_orders(const Scene& scene, const Simulation& simulation, AccuracyState& choice) {
  for (std::size_t k = 0; k < scene.block.size(); ++k)
    if (scene.block[k].automatic_order && !simulation.blocks()[k].fixed())
      choice.orders[static_cast<int>(k)] = simulation.blocks()[k].order();
}

void take_estimate(const AccuracyEstimate& estimate, AccuracyState& choice) {
  choice.order_error = estimate.order;
  choice.sub_face_error = estimate.sub_faces;
  choice.goals = estimate.goals;
  choice.slow_block = estimate.slow_block;
  choice.out_of_reach = estimate.out_of_reach;
}

/// @return false if it was ended
bool choose_in_statics(const LoadedScene& loaded, int threads, const std::function<bool()>& may_continue,
                       AccuracyState& choice) {
  const Scene& scene = loaded.scene;
  BuiltSimulation built = built_or_thrown(loaded, threads);
  Simulation& simulation = built.simulation;
  const std::vector<Measure> measures = measures_of(scene, simulation.blocks());
  const AccuracyRequest request = request_of(scene);
  const GoalValues goals = [&](const Simulation& now) { return goals_of(now, measures); };
  AccuracyRounds rounds;
  const double given = simulation.system().settings().search.chord_tolerance;
  // The run itself tells why blocks of these orders find no equilibrium.
  if (find_equilibrium(simulation, scene.analysis.end_time, request, goals, rounds, may_continue) ==
      StaticStatus::balancing)
    return false;
  choice.rounds = static_cast<int>(rounds.orders.size() + rounds.sub_faces.size());
  take_orders(scene, simulation, choice);
  if (const double chosen = simulation.system().settings().search.chord_tolerance; chosen != given)
    choice.chord_tolerance = chosen;
  take_estimate(accuracy_estimate(goals(simulation), rounds), choice);
  return true;
}

/// @return false if it was ended
bool choose_in_motion(const LoadedScene& loaded, int threads, const std::function<bool()>& may_continue,
                      AccuracyState& choice) {
  const Scene& scene = loaded.scene;
  const AccuracyRequest request = request_of(scene);
  AccuracyRounds rounds;
  for (;;) {
    BuiltSimulation built = built_or_thrown(*with_choice(loaded, choice), threads);
    Simulation& simulation = built.simulation;
    if (scene.analysis.initial_state == SceneAnalysis::InitialState::statics &&
        start_in_statics(simulation, may_continue).end == StaticStart::End::interrupted)
      return false;
    const std::vector<Measure> measures = measures_of(scene, simulation.blocks());
    const GoalValues values = [&](const Simulation& now) { return goals_of(now, measures); };
    std::optional<PilotRun> pilot = pilot_run(simulation, scene.analysis.end_time, values, may_continue);
    if (!pilot) return false;
    ++choice.rounds;
    std::vector<Goal> goals = values(simulation);
    for (std::size_t k = 0; k < goals.size(); ++k) goals[k].values = pilot->round.goals[k];
    choice.motion.scales = std::move(pilot->scales);
    rounds.orders.push_back(std::move(pilot->round));
    const bool goes = raise_orders(simulation, request, goals, rounds);
    take_orders(scene, simulation, choice);
    if (goes) continue;
    take_estimate(accuracy_estimate(goals, rounds), choice);
    return true;
  }
}

/// Shortest time between two rows of a history, s; infinite without histories.
double shortest_gap(const Scene& scene) {
  double gap = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const auto& rows) {
    for (std::size_t k = 1; k < rows.size(); ++k) gap = std::min(gap, rows[k].time - rows[k - 1].time);
  };
  look_at(scene.analysis.gravity_history);
  for (const SceneBlock& block : scene.block) {
    for (const SceneLoad& load : block.load) look_at(load.history);
    for (const SceneFix& fix : block.fix) look_at(fix.history);
  }
  return gap;
}

}  // namespace

std::optional<AccuracyState> choose_for_accuracy(const LoadedScene& loaded, int threads,
                                                 const std::function<bool()>& may_continue) {
  AccuracyState choice;
  const bool statics = loaded.scene.analysis.type == SceneAnalysis::Type::statics;
  const bool done = statics ? choose_in_statics(loaded, threads, may_continue, choice)
                            : choose_in_motion(loaded, threads, may_continue, choice);
  return done ? std::optional(std::move(choice)) : std::nullopt;
}

std::shared_ptr<const LoadedScene> with_choice(const LoadedScene& loaded, const AccuracyState& choice) {
  auto chosen = std::make_shared<LoadedScene>(loaded);
  Scene& scene = chosen->scene;
  for (const auto& [block, order] : choice.orders) scene.block[at(block)].order = order;
  if (choice.chord_tolerance > 0.0) scene.contact.chord_tolerance = choice.chord_tolerance;
  if (scene.analysis.automatic_step)
    scene.analysis.time_step = std::min(scene.analysis.time_step, shortest_gap(scene));
  return chosen;
}

MotionRequest motion_request(const Scene& scene) {
  constexpr double fewest_steps = 16.0;
  return {.accuracy = *scene.analysis.accuracy,
          .longest_step = std::min(scene.analysis.end_time / fewest_steps, shortest_gap(scene)),
          .end_time = scene.analysis.end_time};
}

}  // namespace ashlar

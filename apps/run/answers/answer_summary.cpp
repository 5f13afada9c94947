#include "apps/run/answers/answer_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "apps/run/answers/factor_analysis.hpp"
#include "apps/run/answers/limit_run.hpp"
#include "apps/run/answers/movement_run.hpp"
#include "apps/run/answers/pushover_drawing.hpp"
#include "apps/run/answers/pushover_run.hpp"
#include "apps/run/answers/thrust_run.hpp"

namespace ashlar {
namespace {

RunStatus status_of(const ThrustFindings& thrust) {
  if (!thrust.collapse.empty()) return RunStatus::moving;
  // Movements end with what is known of them.
  return thrust.supports.empty() ? RunStatus::not_converged : RunStatus::completed;
}

nlohmann::ordered_json states_json(const std::vector<ShownState>& states) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < states.size(); ++k) json.push_back({{"step", k + 1}, {"name", states[k].name}});
  return json;
}

RunStatus status_of(const PushoverFindings& pushover) {
  if (pushover.weakest_direction().path.end == PushoverEnd::not_balanced) return RunStatus::moving;
  return is_known(pushover) ? RunStatus::completed : RunStatus::not_converged;
}

/// Displacement and multiplier of each state of a pushover, beside its step and name.
void add_places(nlohmann::ordered_json& states, const Pushover& path) {
  for (std::size_t k = 0; k < std::min(states.size(), path.states.size()); ++k) {
    const PushoverPlace& place = path.places[static_cast<std::size_t>(path.states[k].place)];
    states[k]["displacement"] = place.displacement;
    states[k]["multiplier"] = place.multiplier;
  }
}

/// Where rigid blocks have another factor on the same path, which of both to sign: edges of rigid blocks do not yield as
/// joints do, and friction has several equilibria.
std::string rigid_difference(const Answer& answer) {
  constexpr double alike = 1.03;
  if (!answer.limits || !answer.bracket->lower || !answer.limits->path.answer.lower) return "";
  const double elastic = *answer.bracket->lower, rigid = *answer.limits->path.answer.lower;
  if (elastic <= alike * rigid && rigid <= alike * elastic) return "";
  return fmt::format(
      "; rigid blocks on the same path stand up to {:.5g}: their edges do not yield as joints do, and where "
      "friction has several equilibria the forces that joints have at rest decide; the smaller factor is "
      "safe for both",
      rigid);
}

}  // namespace

void add_answer(nlohmann::ordered_json& summary, const Answer& answer, const SceneAnalysis& analysis,
                const Simulation& simulation) {
  if (answer.shows_states()) summary["states"] = states_json(answer.states);
  if (answer.thrust) summary["thrust"] = thrust_summary(*answer.thrust, simulation);
  if (answer.pushover) {
    const PushedDirection& weakest = answer.pushover->weakest_direction();
    add_places(summary["states"], weakest.path);
    summary["pushover"] = pushover_summary(*answer.pushover, simulation);
    if (weakest.check) summary["kinematic"] = kinematic_summary(*weakest.check);
  }
  if (answer.bracket) {
    summary[factor_name(analysis)] = factor_summary(*answer.bracket, simulation);
    if (answer.limits) summary[factor_name(analysis)]["limit"] = limit_summary(*answer.limits, simulation);
  } else if (answer.limits) {
    summary[factor_name(analysis)] = limit_summary(*answer.limits, simulation);
  }
  if (!answer.method_reason.empty()) summary[factor_name(analysis)]["method_reason"] = answer.method_reason;
}

std::optional<double> factor_of_states(const Answer& answer, const SceneAnalysis& analysis) {
  if (!answer.limits || answer.bracket || analysis.type != SceneAnalysis::Type::capacity) return std::nullopt;
  const PathAnswer& path = answer.limits->path.answer;
  return path.lower ? path.lower : path.upper;
}

AnsweredEnd shown_end(const Answer& answer, const SceneAnalysis& analysis, const Simulation& simulation) {
  if (answer.thrust) return {status_of(*answer.thrust), describe(*answer.thrust, simulation)};
  if (answer.pushover) return {status_of(*answer.pushover), describe(*answer.pushover, simulation)};
  const PathAnswer& path = answer.limits->path.answer;
  const bool known = path.resolved || (path.lower && path.upper);
  return {known ? RunStatus::completed : RunStatus::not_converged,
          describe(*answer.limits, analysis, simulation)};
}

AnsweredEnd bracket_end(const Answer& answer, const SceneAnalysis& analysis, const Simulation& simulation,
                        AnsweredEnd shown) {
  const FactorBracket& bracket = *answer.bracket;
  if (shown.status == RunStatus::interrupted) return shown;
  std::string motion = shown.status == RunStatus::moving ? motion_in_words(simulation) : "";
  if (!motion.empty()) motion.insert(0, ": ");
  const bool known = bracket.resolved || (bracket.lower && bracket.upper);
  return {known ? RunStatus::completed : RunStatus::not_converged,
          describe(bracket, analysis) + motion + rigid_difference(answer)};
}

void draw_answer(const Answer& answer, const Scene& scene, const Simulation& simulation,
                 const std::filesystem::path& folder) {
  if (answer.pushover) write_pushover(*answer.pushover, simulation, folder);
  if (!answer.thrust) return;
  draw_thrust(*answer.thrust, scene, simulation, folder / "thrust.svg");
  draw_movement(answer.thrust->movements, scene, simulation, folder / "movement.svg");
}

}  // namespace ashlar

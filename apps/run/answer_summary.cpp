#include "apps/run/answer_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "apps/run/factor_analysis.hpp"
#include "apps/run/limit_run.hpp"
#include "apps/run/movement_run.hpp"
#include "apps/run/thrust_run.hpp"

namespace ashlar {
namespace {

RunStatus status_of(const ThrustFindings& thrust) {
  if (!thrust.collapse.empty()) return RunStatus::moving;
  const bool known = std::none_of(thrust.movements.begin(), thrust.movements.end(),
                                  [](const SupportMovement& movement) { return is_open(movement); });
  return thrust.supports.empty() || !known ? RunStatus::not_converged : RunStatus::completed;
}

/// Where rigid blocks have another factor on the same path, which of both to sign: friction has several equilibria.
std::string rigid_difference(const Answer& answer) {
  constexpr double alike = 1.03;
  if (!answer.limits || !answer.bracket->lower || !answer.limits->path.answer.lower) return "";
  const double elastic = *answer.bracket->lower, rigid = *answer.limits->path.answer.lower;
  if (elastic <= alike * rigid && rigid <= alike * elastic) return "";
  return fmt::format(
      "; rigid blocks on the same path stand up to {:.5g}: friction has several equilibria here, and the "
      "forces that "
      "joints have at rest decide; the smaller factor is safe for both",
      rigid);
}

}  // namespace

void add_answer(nlohmann::ordered_json& summary, const Answer& answer, const SceneAnalysis& analysis,
                const Simulation& simulation) {
  if (answer.thrust) summary["thrust"] = thrust_summary(*answer.thrust, simulation);
  if (answer.bracket) {
    summary[factor_name(analysis)] = factor_summary(*answer.bracket, simulation);
    if (answer.limits) summary[factor_name(analysis)]["limit"] = limit_summary(*answer.limits, simulation);
  } else if (answer.limits) {
    summary[factor_name(analysis)] = limit_summary(*answer.limits, simulation);
  }
}

AnsweredEnd drawn_end(const Answer& answer, const SceneAnalysis& analysis, const Simulation& simulation) {
  if (answer.thrust) return {status_of(*answer.thrust), describe(*answer.thrust, simulation)};
  return {answer.limits->path.answer.resolved ? RunStatus::completed : RunStatus::not_converged,
          describe(*answer.limits, analysis, simulation)};
}

AnsweredEnd bracket_end(const Answer& answer, const SceneAnalysis& analysis, const Simulation& simulation,
                        AnsweredEnd shown) {
  const FactorBracket& bracket = *answer.bracket;
  if (shown.status == RunStatus::interrupted) return shown;
  std::string motion = shown.status == RunStatus::moving ? motion_in_words(simulation) : "";
  if (!motion.empty()) motion.insert(0, ": ");
  return {bracket.resolved ? RunStatus::completed : RunStatus::not_converged,
          describe(bracket, analysis) + motion + rigid_difference(answer)};
}

void draw_answer(const Answer& answer, const Scene& scene, const Simulation& simulation,
                 const std::filesystem::path& folder) {
  if (!answer.thrust) return;
  draw_thrust(*answer.thrust, scene, simulation, folder / "thrust.svg");
  draw_movement(answer.thrust->movements, scene, simulation, folder / "movement.svg");
}

}  // namespace ashlar

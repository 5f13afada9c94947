// analysis.type "factor-of-safety" and "capacity": the static analyses of a search for a factor, and the summary of
// their result.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/answers/factor_search.hpp"
#include "apps/scene/assemble/build_simulation.hpp"

namespace ashlar {

/// True if the analysis is a search for a factor.
[[nodiscard]] bool seeks_factor(const SceneAnalysis& analysis);

/// Range and tolerance of the search.
[[nodiscard]] const SceneAnalysis::FactorSearch& search_of(const SceneAnalysis& analysis);

/// Key of the factor in the summary: "factor_of_safety" or "load_factor".
[[nodiscard]] const char* factor_name(const SceneAnalysis& analysis);

/// Factors on strengths and loads of the scene for a factor of the search.
[[nodiscard]] TrialFactors trial_factors(const SceneAnalysis& analysis, double factor);

/// An iteration of a static analysis under loads of a time, which ends as moving once blocks are displaced: wherever
/// they come to rest, it is not their initial placement. Collective, as all functions of a simulation
/// here that change it or decide about it.
[[nodiscard]] StaticStatus trial_step(Simulation& simulation, double end_time);

/// The same; an iteration that cannot be taken ends the analysis as inconclusive. @throws std::bad_alloc, as more memory
/// may resolve it; of several processes any exception, as others may wait for this one
[[nodiscard]] StaticStatus attempted_step(Simulation& simulation, double end_time);

/// Outcome of a static analysis that has ended.
[[nodiscard]] TrialOutcome outcome_of(StaticStatus status, const Simulation& simulation);

/// One static analysis under loads of a time, from the present state to its end.
[[nodiscard]] FactorTrial run_trial(Simulation& simulation, double factor, double end_time);

/// Factor of the results to show: the smallest that moves, or if none does the largest that stands.
[[nodiscard]] double shown_factor(const FactorBracket& bracket, const SceneAnalysis::FactorSearch& search);

/// An array of factor, outcome, iterations.
[[nodiscard]] nlohmann::ordered_json trials_json(const std::vector<FactorTrial>& trials);

/// "0.5 stands, 1 moves", "no factor is known to stand, 1 moves": for a search that was interrupted.
[[nodiscard]] std::string bracket_so_far(const FactorBracket& bracket);

/// "factor of safety between 1.09 and 1.1", with parts that were not found.
[[nodiscard]] std::string describe(const FactorBracket& bracket, const SceneAnalysis& analysis);

/// method, lower, upper (null if there is none), trials. If blocks move: moving (names), accelerations (m/s^2),
/// angular_accelerations (rad/s^2), joints (of moving blocks: blocks, mode "slides", "sticks" or "opens").
/// @param simulation at the end of the static analysis under shown_factor
[[nodiscard]] nlohmann::ordered_json factor_summary(const FactorBracket& bracket,
                                                    const Simulation& simulation);

}  // namespace ashlar

// analysis.type "factor-of-safety" and "capacity": the static analyses of a search for a factor, kept in the result
// folder one by one, and what their answer says in the summary.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/run/factor_search.hpp"
#include "apps/scene/build_simulation.hpp"

namespace ashlar {

/// Whether the analysis is a search for a factor.
[[nodiscard]] bool seeks_factor(const SceneAnalysis& analysis);

/// Its range and tolerance.
[[nodiscard]] const SceneAnalysis::FactorSearch& search_of(const SceneAnalysis& analysis);

/// "factor_of_safety" or "load_factor": the word for it in the summary.
[[nodiscard]] const char* factor_name(const SceneAnalysis& analysis);

/// The scene's strengths or loads under a factor.
[[nodiscard]] TrialFactors trial_factors(const SceneAnalysis& analysis, double factor);

/// An iteration of a static analysis under loads of a time, which ends as moving once blocks are displaced: wherever
/// they would come to rest, it is not where they were placed.
[[nodiscard]] StaticStatus trial_step(Simulation& simulation, double end_time);

/// One static analysis under loads of a time, from where blocks are. @param goes_on asked before each iteration
/// @return empty: it was told to stop
[[nodiscard]] std::optional<FactorTrial> run_trial(Simulation& simulation, double factor, double end_time,
                                                   const std::function<bool()>& goes_on);

/// Trials that were run before, in `factor_trials.json` of a result folder, so that a search that was ended goes on
/// after its last whole trial.
class TrialFile {
 public:
  /// Reads the file if it is there. @param hash of the scene (run_checkpoint.hpp). @param resume false: a file that
  /// is there is removed
  /// @throws std::runtime_error if it is damaged or of another scene
  TrialFile(std::filesystem::path path, std::uint64_t hash, bool resume);
  /// The trial of a factor, if it has been run.
  [[nodiscard]] std::optional<FactorTrial> find(double factor) const;
  /// @throws std::runtime_error with path and reason
  void add(const FactorTrial& trial);

 private:
  std::filesystem::path path_;
  std::uint64_t hash_;
  std::vector<FactorTrial> trials_;
};

/// The factor to show: the least that moves; where none does the largest that stands.
[[nodiscard]] double shown_factor(const FactorBracket& bracket, const SceneAnalysis::FactorSearch& search);

/// "0.5 stands, 1 moves", "no factor is known to stand, 1 moves": of a search that was stopped.
[[nodiscard]] std::string bracket_so_far(const FactorBracket& bracket);

/// "factor of safety between 1.09 and 1.1", in words, with what could not be found.
[[nodiscard]] std::string describe(const FactorBracket& bracket, const SceneAnalysis& analysis);

/// method, lower, upper (null where there is none), trials; where blocks move: moving (names), accelerations (m/s^2),
/// angular_accelerations (rad/s^2), joints (of moving blocks: blocks, mode "slides", "sticks" or "opens").
/// @param simulation at the end of the static analysis under shown_factor
[[nodiscard]] nlohmann::ordered_json factor_summary(const FactorBracket& bracket,
                                                    const Simulation& simulation);

}  // namespace ashlar

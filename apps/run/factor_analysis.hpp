// analysis.type "factor-of-safety" and "capacity": the static analyses of a search for a factor, stored one by one in
// the result folder, and the summary of their result.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/run/factor_search.hpp"
#include "apps/scene/build/build_simulation.hpp"

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
/// they come to rest, it is not their initial placement.
[[nodiscard]] StaticStatus trial_step(Simulation& simulation, double end_time);

/// One static analysis under loads of a time, from the present state. @param goes_on called before each iteration;
/// false ends the analysis
/// @return empty if it was ended
[[nodiscard]] std::optional<FactorTrial> run_trial(Simulation& simulation, double factor, double end_time,
                                                   const std::function<bool()>& goes_on);

/// Earlier trials in `factor_trials.json` of a result folder, so that an interrupted search continues after its last
/// complete trial.
class TrialFile {
 public:
  /// Reads the file if it exists. @param hash of the scene (run_checkpoint.hpp). @param resume false: an existing
  /// file is removed
  /// @throws std::runtime_error if it is damaged or belongs to another scene
  TrialFile(std::filesystem::path path, std::uint64_t hash, bool resume);
  /// Trial of a factor, if it is stored.
  [[nodiscard]] std::optional<FactorTrial> find(double factor) const;
  /// @throws std::runtime_error with path and reason
  void add(const FactorTrial& trial);

 private:
  std::filesystem::path path_;
  std::uint64_t hash_;
  std::vector<FactorTrial> trials_;
};

/// Factor of the results to show: the smallest that moves, or if none does the largest that stands.
[[nodiscard]] double shown_factor(const FactorBracket& bracket, const SceneAnalysis::FactorSearch& search);

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

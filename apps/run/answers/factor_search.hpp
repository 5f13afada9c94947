// The factor at which a structure begins to move, bracketed by static analyses: by strength reduction (factor of
// safety) or load increase (capacity). In both, a larger factor is closer to motion.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Result of a static analysis under a factor.
enum class TrialOutcome {
  stands,   ///< equilibrium where blocks were placed
  moves,    ///< no equilibrium near, or one far from there
  unknown,  ///< inconclusive
};
[[nodiscard]] std::string to_string(TrialOutcome outcome);

struct FactorTrial {
  double factor = 0.0;
  TrialOutcome outcome = TrialOutcome::unknown;
  int iterations = 0;  ///< of the static analysis
};

/// Result of the search.
struct FactorBracket {
  std::optional<double> lower;      ///< the largest factor that stands; empty: even the least moves
  std::optional<double> upper;      ///< the least factor that moves; empty: even the largest stands
  bool resolved = false;            ///< upper / lower is within the tolerance, or one of them is empty
  bool interrupted = false;         ///< the search was interrupted
  std::vector<FactorTrial> trials;  ///< in order
};

/// Bounds of the limit by another method, tried first.
struct ExpectedFactor {
  double lower = 0.0;  ///< expected to stand
  double upper = 0.0;  ///< expected to move
};

/// Starts at the factor 1, or the closest allowed one. Halves until blocks stand, doubles until they move, and then
/// halves the bracket in ratio until its width is within the tolerance. Inconclusive trials are assumed to surround
/// the limit: the search continues below and above them, and ends unresolved once they are within a quarter of the
/// tolerance of both ends. Each factor depends on the earlier trials only.
class FactorSearch {
 public:
  /// @param expected tried first: if one end stands and the other moves, within the tolerance, they are the result
  explicit FactorSearch(const SceneAnalysis::FactorSearch& range,
                        const std::optional<ExpectedFactor>& expected = {});

  /// The next factor to try, within range.lower and upper; empty: the search has ended.
  [[nodiscard]] std::optional<double> next() const;
  /// @param trial of next()
  void add(const FactorTrial& trial);
  /// Result so far; resolved only if the search has ended.
  [[nodiscard]] FactorBracket bracket() const;

 private:
  [[nodiscard]] bool resolved() const;
  [[nodiscard]] std::optional<double> middle() const;

  SceneAnalysis::FactorSearch range_;
  double low_, high_;      ///< tried first, low_ <= high_
  FactorBracket bracket_;  ///< resolved and interrupted are unused
};

/// Searches to the end. @param attempt its factor is within search.lower and upper; an empty result interrupts the
/// search
[[nodiscard]] FactorBracket find_factor(const SceneAnalysis::FactorSearch& search,
                                        const std::function<std::optional<FactorTrial>(double)>& attempt,
                                        const std::optional<ExpectedFactor>& expected = {});

}  // namespace ashlar

// The factor at which a structure begins to move, bracketed by static analyses: of strength reduction (the factor of
// safety) and of load increase (the capacity). With both, more is nearer to motion.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"

namespace ashlar {

/// What a static analysis under a factor found.
enum class TrialOutcome {
  stands,   ///< equilibrium where blocks were placed
  moves,    ///< no equilibrium near, or one far from there
  unknown,  ///< neither was found
};
[[nodiscard]] std::string to_string(TrialOutcome outcome);

struct FactorTrial {
  double factor = 0.0;
  TrialOutcome outcome = TrialOutcome::unknown;
  int iterations = 0;  ///< of the static analysis
};

/// What is known once the search ends.
struct FactorBracket {
  std::optional<double> lower;      ///< the largest factor that stands; empty: even the least moves
  std::optional<double> upper;      ///< the least factor that moves; empty: even the largest stands
  bool resolved = false;            ///< upper / lower is within the tolerance, or one of them is empty
  bool interrupted = false;         ///< it was told to stop
  std::vector<FactorTrial> trials;  ///< in order
};

/// Bounds of the limit by another method, to be tried first.
struct ExpectedFactor {
  double lower = 0.0;  ///< expected to stand
  double upper = 0.0;  ///< expected to move
};

/// Starts at the factor 1, or the allowed one nearest to it; halves until blocks stand, doubles until they move, and
/// then halves the bracket in ratio until its width is within the tolerance. Trials that say nothing are taken to lie
/// around the limit: the search goes on below and above them, and ends unresolved once they reach to within a quarter
/// of the tolerance of both ends.
/// @param attempt its factor is within search.lower and upper; empty: stop
/// @param expected starts at its ends: if one stands and the other moves, within the tolerance, they are the answer
[[nodiscard]] FactorBracket find_factor(const SceneAnalysis::FactorSearch& search,
                                        const std::function<std::optional<FactorTrial>(double)>& attempt,
                                        const std::optional<ExpectedFactor>& expected = {});

}  // namespace ashlar

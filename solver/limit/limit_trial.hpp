// A pair of factors tried by limit analysis, and the bracket of a limit.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/limit/released_motion.hpp"

namespace ashlar {

/// Strengths of chosen joints are divided by the first factor, chosen loads are multiplied by the second one.
struct LimitFactors {
  double strength = 1.0;
  double load = 1.0;
};

/// Result of one pair of factors.
struct LimitTrial {
  LimitFactors factors;
  bool released = false;  ///< true: of the released limit, false: of the associated one (limit_analysis.hpp)
  LimitOutcome outcome = LimitOutcome::unknown;
  bool balanced = false;  ///< forces within the strengths that balance the loads exist
  bool slow = false;      ///< its motion is slow slip, scaled to negligible acceleration; else accelerations
  std::vector<BodyVelocity> acceleration;  ///< by body, from rest, in coordinates and units of the model
  std::vector<Eigen::Vector3d> force;      ///< by point, in units of the model
  /// For a trial that moves: estimate of the factor at which its motion would be in balance; 0: none.
  double estimate = 0.0;
  int programmes = 0;
  int iterations = 0;  ///< of all its programmes, and sweeps
};

/// Which of both factors is sought; the other one is 1.
enum class Sought { strength, load };

/// Range and accuracy of a search for a factor.
struct LimitSearch {
  double lower = 0.1;       ///< > 0
  double upper = 10.0;      ///< > lower
  double tolerance = 0.01;  ///< > 0: relative width of the bracket
};

/// Distance of a trial below an estimated limit, of the tolerance: smaller values may miss the limit by the error of its
/// estimate, and 1 leaves no width for a bracket by two trials.
inline constexpr double below_estimate = 0.3;

/// Bounds of one of the two limits.
struct LimitBracket {
  std::optional<double> lower;       ///< the largest factor that stands; empty: even the least moves
  std::optional<double> upper;       ///< the least factor that moves; empty: even the largest stands
  bool resolved = false;             ///< upper / lower - 1 is within the tolerance, or one of them is empty
  std::optional<LimitTrial> motion;  ///< of `upper`
};

/// @return empty to end the search
using LimitAttempt = std::function<std::optional<LimitTrial>(double)>;

/// Tries factors until the limit is bracketed: trials stand below it and move above.
/// @param bracket known so far. @param first the factor to begin with, within the search
/// @param guess of the limit; 0: none. @param stride the largest ratio by which a factor is lowered from one that
/// moves, > 1: a motion is followed from factor to factor, and lost if they are too far apart
void narrow(LimitBracket& bracket, const LimitSearch& search, double first, double guess, double stride,
            const LimitAttempt& attempt);

/// "stands", "moves", "unknown"
[[nodiscard]] const char* to_string(LimitOutcome outcome);

}  // namespace ashlar

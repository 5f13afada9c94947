// A pair of factors that limit analysis has tried, and the bracket that such trials leave of a limit.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/statics/released_motion.hpp"

namespace ashlar {

/// Strengths of chosen joints are divided by one, loads that are multiplied are multiplied by the other.
struct LimitFactors {
  double strength = 1.0;
  double load = 1.0;
};

/// Result of one pair of factors.
struct LimitTrial {
  LimitFactors factors;
  bool released = false;  ///< which of the two limits it is of (limit_analysis.hpp)
  LimitOutcome outcome = LimitOutcome::unknown;
  bool balanced = false;  ///< forces within the strengths that balance the loads exist
  bool slow = false;      ///< its motion is slow slip, of the size of rest; else accelerations
  std::vector<BodyVelocity> acceleration;  ///< by body, from rest, in coordinates and units of the model
  std::vector<Eigen::Vector3d> force;      ///< by point, in units of the model
  /// Of a trial that moves: the factor at which its motion would be in balance; 0: none.
  double estimate = 0.0;
  int programmes = 0;
  int iterations = 0;  ///< of all its programmes, and sweeps
};

/// Where to look for a factor, and how well it is to be known.
struct LimitSearch {
  double lower = 0.1;       ///< > 0
  double upper = 10.0;      ///< > lower
  double tolerance = 0.01;  ///< > 0: relative width of the bracket
};

/// Bounds of one of the two limits.
struct LimitBracket {
  std::optional<double> lower;       ///< the largest factor that stands; empty: even the least moves
  std::optional<double> upper;       ///< the least factor that moves; empty: even the largest stands
  bool resolved = false;             ///< upper / lower - 1 is within the tolerance, or one of them is empty
  std::optional<LimitTrial> motion;  ///< of `upper`
};

/// @return empty: the search is to end
using LimitAttempt = std::function<std::optional<LimitTrial>(double)>;

/// Tries factors until the limit is known: trials stand below it and move above.
/// @param bracket what is known already. @param first the factor to begin with, within the search
/// @param guess of the limit; 0: none. @param stride the most by which a factor goes down from one that moves, > 1: a
/// motion is followed from factor to factor, and lost where they are too far apart
void narrow(LimitBracket& bracket, const LimitSearch& search, double first, double guess, double stride,
            const LimitAttempt& attempt);

/// "stands", "moves", "unknown"
[[nodiscard]] const char* to_string(LimitOutcome outcome);

}  // namespace ashlar

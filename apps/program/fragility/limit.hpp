// Limits of a run: "storey.drift > 0.02", "top.ux - base.ux >= 0.1", "collapse".
//
// The left side, the demand, is a formula (formulas.hpp) of columns of history.csv, the right side a number or a formula of
// numbers. Names with other characters are in single quotes: 'stone 1.uz'. The name alone of a measure of a drift stands
// for its column NAME.drift. A run exceeds a limit as soon as a step does, and each limit as soon as it collapses.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace ashlar {

struct Limit {
  std::string text;      ///< as given, blanks at its ends removed
  std::string demand;    ///< text of the left side; empty for the collapse
  bool above = true;     ///< exceeded by demands above the bound, otherwise by those below
  bool reached = false;  ///< exceeded by the bound itself too (>= and <=)
  double bound = 0.0;

  /// True for "collapse": a block has fallen or overturned (collapse_watch.hpp).
  [[nodiscard]] bool is_collapse() const { return demand.empty(); }
  [[nodiscard]] bool exceeded_by(double value) const {
    return value == bound ? reached : above ? value > bound : value < bound;
  }
  /// The demand nearer to the limit, or farther beyond it; one that is nan gives way.
  [[nodiscard]] double worse(double one, double other) const;
};

/// @throws std::invalid_argument with the fault and the requirement: no comparison or several, sides without value
[[nodiscard]] Limit parse_limit(const std::string& text);

/// The demand in a row of the history; nan where it has no value.
using DemandOfRow = std::function<double(std::span<const double> row)>;

/// @param columns of the rows
/// @throws std::invalid_argument with the fault and the requirement: an unknown column, a malformed formula
[[nodiscard]] DemandOfRow demand_of_row(const Limit& limit, const std::vector<std::string>& columns);

}  // namespace ashlar

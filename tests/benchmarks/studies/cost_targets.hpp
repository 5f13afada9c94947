// Run time and memory of scenes of many blocks compared with their targets and with a rigid-body engine.
//
// Times are processor seconds of one thread in steps of 1/240 s. Times of different machines are made comparable by a
// fixed amount of small dense factorisations, the main work of both programs: seconds here over `machine_factor`.
// The machine of reference took 0.208 s for that amount. The engine is Bullet 3.24 there: convex hulls, 10 iterations,
// sleeping off, least of several runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace ashlar {

/// One figure. Smaller is better unless it is a speedup.
struct CostFigure {
  std::string what;
  double measured = 0.0;  ///< not a number: the scene did not run to its end
  double target = 0.0;
  std::string unit;
  bool speedup = false;

  [[nodiscard]] bool met() const { return speedup ? measured >= target : measured <= target; }
};

/// Extent of the measurement.
struct CostFigureSize {
  /// 0 to 1: scenes with fewer blocks and steps, whose figures only show that they are measured
  double share = 1.0;
};

/// Time of small dense factorisations here relative to the machine of reference.
[[nodiscard]] double machine_factor();

/// @param measured receives each figure as soon as it is known
[[nodiscard]] std::vector<CostFigure> cost_figures(const CostFigureSize& size,
                                                   const std::function<void(const CostFigure&)>& measured);

/// Name, measured value, target, verdict.
[[nodiscard]] std::string target_line(const CostFigure& figure);

}  // namespace ashlar

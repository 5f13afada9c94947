// Run time and memory of scenes of many blocks beside their targets, and beside a rigid-body engine.
//
// Times are processor seconds of one thread in steps of 1/240 s. Those of another machine are made comparable by a fixed
// amount of small dense factorisations, which is most of what both programs do: seconds here over `machine_factor`. Those
// of the engine (Bullet 3.24, convex hulls, 10 iterations, sleeping off) were measured beside that amount on one machine.
#pragma once

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

/// How far the measurement goes.
struct CostFigureSize {
  /// 0 to 1: scenes with fewer blocks and steps, whose figures say nothing but that they are measured
  double share = 1.0;
};

/// How many times as long as on the machine of reference small dense factorisations take here.
[[nodiscard]] double machine_factor();

[[nodiscard]] std::vector<CostFigure> cost_figures(const CostFigureSize& size);

/// A line for each: what, measured, target, whether it is met.
[[nodiscard]] std::vector<std::string> target_lines(const std::vector<CostFigure>& figures);

}  // namespace ashlar

// Work of estimates of the errors of orders, and of runs, by counts alone: the same run has the same estimates in its
// summary, on any machine, resumed or not.
//
// A unit is about a nanosecond of one core. With p functions and t triangles (measured, notes/run_time.md):
//     constant data of a block       20 p^3 + 50 t p^2        moments, Cholesky factor and derivatives in 32 digits
//     solution for a residual         6 p^3                   LDL' of 3p unknowns
//     step of a block                20,000 + 100 p^2         without contacts
//     contact point in a step         3,000
// Equal blocks share their constant data. The work of a run is rather too small: Newton iterations are not in it.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Share of a run's work that the estimate at its end may take.
inline constexpr double estimate_share = 0.05;
/// Work that it may take in any case: 0.2 s.
inline constexpr double least_estimate_work = 2e8;

/// Of the constant data of a block in an order.
[[nodiscard]] double work_of_model(const BlockModel& block, int order);
/// Of its solution for a residual.
[[nodiscard]] double work_of_solution(const BlockModel& block, int order);
/// Of the models of all blocks and of all steps so far, those of earlier stages included.
[[nodiscard]] double work_of_run(const Simulation& simulation);
/// The larger one of the two limits above.
[[nodiscard]] double largest_estimate_work(const Simulation& simulation);

/// Most blocks that share a model of higher order: more are left to other threads.
inline constexpr std::size_t largest_equal_group = 64;

/// Groups of blocks whose models of higher order have the same constant data, to the bit: those whose parts() are the same,
/// of linear elasticity and without supports, which are computed from places. Others are alone in theirs.
/// @param chosen blocks, each once. @return in the order of their first blocks, none larger than largest_equal_group
[[nodiscard]] std::vector<std::vector<int>> equal_blocks(const std::vector<BlockModel>& blocks,
                                                         const std::vector<int>& chosen);

/// Work that is left for estimates.
class EstimateBudget {
 public:
  /// @param work >= 0, may be infinite
  explicit EstimateBudget(double work) : left_(work) {}

  /// Takes the work of a block, with that of its constant data if it is the first of a group (equal_blocks).
  /// @param order of the estimate. @return false if there is less left: nothing is taken
  [[nodiscard]] bool take(const BlockModel& block, int order);

 private:
  double left_;
  std::map<const BlockParts*, std::size_t> counted_;  ///< number of blocks by their shared data
};

}  // namespace ashlar

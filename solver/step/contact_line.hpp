// Work of contact forces along a change of the guess, for line searches. Gaps and slips of points are linear in the share
// of the change that is made, so that their forces take a loop over points: no rows, no sums by block.
#pragma once

#include <vector>

#include "solver/step/island_equations.hpp"

namespace ashlar {

/// Lasts as long as the laws of the problem do.
class ContactLine {
 public:
  /// @param change of the unknowns in the island's equations. @param share of it that the present guess has
  ContactLine(const IslandProblem& problem, const Eigen::VectorXd& change, double share);

  /// Of all points, per share, J. Forces of blocks, inertia and shifts to common points are not in it. The sum does not
  /// depend on the number of threads
  [[nodiscard]] double work(double share) const;

 private:
  /// Gap over the rest and trial slip of a pair's points, (3, #points), m.
  struct PairLine {
    Eigen::Matrix3Xd start;  ///< at share 0
    Eigen::Matrix3Xd way;    ///< of the whole change
  };

  const IslandProblem& problem_;
  std::vector<PairLine> lines_;  ///< by pair
};

}  // namespace ashlar

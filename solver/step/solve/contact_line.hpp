// Work of contact forces along a change of the guess, for line searches. Gaps and slips of points are linear in the
// share of the change, so that their forces take one loop over points, without rows and sums by block.
#pragma once

#include <vector>

#include "solver/step/island/island_equations.hpp"

namespace ashlar {

/// Valid as long as the laws of the problem.
class ContactLine {
 public:
  /// @param change of the unknowns in the island's equations. @param share of the change in the present guess
  ContactLine(const IslandProblem& problem, const Eigen::VectorXd& change, double share);

  /// Work of all points and bolts per share, J, without forces of blocks, inertia and shifts to common points. It does
  /// not depend on the number of threads.
  [[nodiscard]] double work(double share) const;

 private:
  /// Gap over the rest and trial slip of a pair's points, (3, #points), m.
  struct PairLine {
    Eigen::Matrix3Xd start;  ///< at share 0
    Eigen::Matrix3Xd whole;  ///< change over the whole step of the line
  };

  /// Deformation of a bolt, m.
  struct BoltLine {
    Eigen::VectorXd start;
    Eigen::VectorXd whole;
  };

  /// True on one of the processes that share the island: each bolt counts once.
  [[nodiscard]] bool owns_bolt(std::size_t k) const;

  const IslandProblem& problem_;
  std::vector<PairLine> lines_;  ///< by pair
  std::vector<BoltLine> bolts_;  ///< by bolt
};

}  // namespace ashlar

// The linear system of one island: the tangent of its equations (island_equations.hpp) at the last responses, and what a
// change of the guess has to be for the linearised equations to balance (theory.md section 10).
//
//   T = d rho inertia I + w s (1 + k) Z' R K R' Z + sum over pairs of C' t C
//
// with t the stiffness of each contact point, 3 x 3. What friction's dependence on the normal force adds to t is not
// symmetric: GMRES takes it, the factor is of the symmetric rest. Beside a factor of an earlier step
// (notes/old_factors.md) GMRES needs a few products T x only, so that T is not assembled where these cost less.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/step/island_equations.hpp"

namespace ashlar {

/// To be used while the problem lives. The factor stays in the problem's solver.
class IslandTangent {
 public:
  explicit IslandTangent(const IslandProblem& problem) : problem_(problem), solver_(problem.solver()) {}

  /// Assembles and factorises the symmetric part at the last responses.
  [[nodiscard]] FactorStatus factorize();
  /// Makes the system of the last responses ready, and leaves the factor that an earlier step may have left: solve()
  /// takes that for a preconditioner, and makes a new one where it is none.
  [[nodiscard]] FactorStatus update_factor();
  /// Change of the guess that the linearised equations ask for. @param right_side (equations), N
  /// @param coupled with the dependence of friction on normal forces; without, the tangent is symmetric
  /// @return (equations); not a number where no factor can be made
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool coupled);

 private:
  /// Product of the stiffnesses of the points of one of the island's pairs, along x, y, z, and a change.
  struct PairProduct {
    std::size_t pair;
    PointStiffnesses points;
    Eigen::VectorXd on_a;  ///< the product, forces on the unknowns of a, N; empty: it does not move
    Eigen::VectorXd on_b;
  };

  /// @param positive leave out what may make it indefinite
  void assemble(bool positive);
  /// Factorises what has been assembled. @param kept for later steps
  [[nodiscard]] FactorStatus factorize_assembled(bool kept);
  /// Whether the products of one solution with an old factor cost less than to assemble the matrix.
  [[nodiscard]] bool products_pay() const;
  /// w s (1 + k), of the stiffness of blocks.
  [[nodiscard]] double weight_of_blocks() const;
  /// Adds what the blocks' inertia and stiffness make of a change. @param x (equations)
  void add_blocks(const Eigen::VectorXd& x, Eigen::VectorXd& force) const;
  /// Of pairs that have stiffnesses. @param stiffnesses of the points of a pair, without columns: none
  [[nodiscard]] std::vector<PairProduct> products_of(
      const std::function<PointStiffnesses(std::size_t pair)>& stiffnesses) const;
  /// Adds products of the stiffnesses of contact points and a change. @param x (equations)
  void add_pairs(std::vector<PairProduct>& products, const Eigen::VectorXd& x, Eigen::VectorXd& force) const;
  /// Solves with an old factor. @return empty if it is none any more
  [[nodiscard]] Eigen::VectorXd solve_with_old(const Eigen::VectorXd& right_side, bool coupled) const;

  const IslandProblem& problem_;
  IslandSolvers::Entry& solver_;
  bool factor_is_old_ = false;  ///< of another matrix than that of the last responses
  bool assembled_ = false;      ///< since update_factor() was called
};

}  // namespace ashlar

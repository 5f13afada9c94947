// The linear system of one island: the tangent of its equations (island_equations.hpp) at the last responses, and the
// change of the guess that balances the linearised equations (theory.md section 10).
//
//   T = d rho inertia I + w s (1 + k) Z' R K R' Z + w b Z' B Z + sum over pairs of C' t C
//
// with B the dashpots of quiet faces, b the share of the change in their velocity, and t the stiffness of each contact
// point, 3 x 3. The dependence of friction on the normal force makes t unsymmetric: GMRES includes it, the factor is
// of the symmetric part. With a factor of an earlier step as preconditioner (notes/old_factors.md) GMRES needs a few
// products T x only. T is not assembled where these cost less.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "solver/linear/gmres.hpp"
#include "solver/step/island/island_equations.hpp"

namespace ashlar {

/// Must not outlive the problem. The factor stays in the problem's solver.
class IslandTangent {
 public:
  explicit IslandTangent(const IslandProblem& problem) : problem_(problem), solver_(problem.solver()) {}

  /// Assembles and factorises the symmetric part at the last responses.
  [[nodiscard]] FactorStatus factorize();
  /// Prepares the system of the last responses and leaves a factor of an earlier step in place: solve() uses it as a
  /// preconditioner, and makes a new one if it fails.
  [[nodiscard]] FactorStatus update_factor();
  /// Solves the linearised equations for a change of the guess. @param right_side (equations), N
  /// @param coupled with the dependence of friction on normal forces; without it, the tangent is symmetric
  /// @return (equations); not a number if no factor can be made
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side, bool coupled);

 private:
  /// Product of a change and the stiffnesses of the points of a pair, along x, y, z.
  struct PairProduct {
    PointStiffnesses points;  ///< without columns: none
    Eigen::VectorXd on_a;     ///< forces on the unknowns of a, N; empty: fixed
    Eigen::VectorXd on_b;
  };

  /// @param positive leave out terms that may make the matrix indefinite
  void assemble(bool positive);
  /// Sets precision and threads of the factor.
  void prepare_factor() const;
  /// Factorises the assembled matrix. @param kept for later steps
  [[nodiscard]] FactorStatus factorize_assembled(bool kept);
  /// True if the products of one solution with an old factor cost less than assembly of the matrix, on all processes
  /// together.
  [[nodiscard]] bool products_pay() const;
  /// Of vectors that several processes share; empty: one process has all.
  [[nodiscard]] InnerProducts inner_products() const;
  /// w s (1 + k), weight of the stiffness of blocks.
  [[nodiscard]] double weight_of_blocks() const;
  /// w b, weight of the dashpots of quiet faces.
  [[nodiscard]] double weight_of_dashpots() const;
  /// Adds the forces of the blocks' inertia and stiffness due to a change. @param x (equations)
  void add_blocks(const Eigen::VectorXd& x, Eigen::VectorXd& force) const;
  /// Products of all pairs. @param stiffnesses of the points of a pair, without columns: none
  [[nodiscard]] std::vector<PairProduct> products_of(
      const std::function<PointStiffnesses(std::size_t pair)>& stiffnesses) const;
  /// Adds products of the stiffnesses of contact points and a change. @param with_bolts those of bolts too
  /// @param x (equations)
  void add_pairs(std::vector<PairProduct>& products, bool with_bolts, const Eigen::VectorXd& x,
                 Eigen::VectorXd& force) const;
  /// Solves with an old factor. @return none if it no longer preconditions the system
  [[nodiscard]] std::optional<Eigen::VectorXd> solve_with_old(const Eigen::VectorXd& right_side,
                                                              bool coupled) const;

  const IslandProblem& problem_;
  IslandSolvers::Entry& solver_;
  bool factor_is_old_ = false;  ///< factor of another matrix than that of the last responses
  bool assembled_ = false;      ///< since update_factor() was called
};

}  // namespace ashlar

// A linear solver of PETSc with its matrix. For sources of this folder.
#pragma once

#include <petscksp.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/ranks/mpi/petsc_matrix.hpp"
#include "solver/ranks/rank_solver.hpp"

namespace ashlar {

/// Functions are collective.
class PetscMethod {
 public:
  /// Numbers the unknowns of a pattern.
  /// @param most_factored unknowns up to which a factor is the default
  /// @param prefix of its options: "" for those of users
  PetscMethod(Ranks& ranks, const std::vector<BodyRows>& rows, std::int64_t most_factored,
              std::string prefix);
  ~PetscMethod();
  PetscMethod(const PetscMethod&) = delete;
  PetscMethod& operator=(const PetscMethod&) = delete;

  /// True if rows have the pattern of this on all ranks.
  [[nodiscard]] bool has_pattern_of(const std::vector<BodyRows>& rows) const {
    return matrix_.has_pattern_of(rows);
  }
  /// False: by a factor, refined to rounding error.
  [[nodiscard]] bool iterates() const { return iterates_; }
  /// Prepares solutions. @param rows of the pattern. @throws std::bad_alloc without memory for a factor
  [[nodiscard]] FactorStatus set_up(const std::vector<BodyRows>& rows);
  /// @param refined to rounding error. @return false if it did not converge, or the matrix turns out to be indefinite
  [[nodiscard]] bool solve(const Eigen::VectorXd& right_side, bool refined, Eigen::VectorXd& solution);
  /// Cost of set_up() relative to a solution, by MUMPS's counts of the pattern; 0 for other methods, and before the first.
  [[nodiscard]] double cost_in_solves() const { return cost_in_solves_; }
  /// Iterations of all solutions.
  [[nodiscard]] std::uint64_t iterations() const { return iterations_; }

 private:
  [[nodiscard]] std::string option(const char* name) const;
  void choose(std::int64_t most_factored);
  [[nodiscard]] PCFailedReason factorize();
  void refine();
  void count_cost(Mat factor);

  PetscMatrix matrix_;
  std::string prefix_;
  bool iterates_ = false;
  bool by_mumps_ = false;
  bool by_multigrid_ = false;
  KSP solver_ = nullptr;
  PC preconditioner_ = nullptr;
  Vec right_side_ = nullptr;
  Vec solution_ = nullptr;
  Vec residual_ = nullptr;
  Vec correction_ = nullptr;
  std::uint64_t iterations_ = 0;
  double cost_in_solves_ = 0.0;
  PetscReal refined_tolerance_ = 0.0;  ///< of an iteration, relative
};

}  // namespace ashlar

// A RankSolver by PETSc.
//
// By default a Cholesky factor (MUMPS) up to most_factored unknowns; beyond, conjugate gradients with algebraic multigrid
// (GAMG), whose coarse spaces hold the rigid motions of the bodies. PETSc's options choose others: -ksp_type, -pc_type,
// -mat_type, ..., see PETSc's manual; -ksp_type preonly with a factor is refined to rounding error, other solvers iterate
// to petsc_refined_tolerance unless -ksp_rtol is given.
//
// A matrix of bodies of one size is stored by blocks (SBAIJ for a factor), another by entries. A factor's analysis is kept
// while the pattern of blocks stays the same on all ranks. Sums of parallel factors depend on the order in which messages
// arrive: two runs on more than one rank may differ by rounding.
#pragma once

#include <cstdint>
#include <memory>

#include "solver/ranks/rank_solver.hpp"

namespace ashlar {

/// Limits of the default method. ../../notes/rank_solver.md has the measurements.
struct PetscSolverLimits {
  std::int64_t most_factored = 100'000;  ///< unknowns of all ranks up to which a factor is the default
};

/// Residual of iterated solutions relative to the right side, of refined ones and of others.
inline constexpr double petsc_refined_tolerance = 1e-12;
inline constexpr double petsc_tolerance = 1e-6;

/// Collective. @param ranks all of the program, after an MpiSession began
[[nodiscard]] std::unique_ptr<RankSolver> make_petsc_solver(Ranks& ranks,
                                                            const PetscSolverLimits& limits = {});

}  // namespace ashlar

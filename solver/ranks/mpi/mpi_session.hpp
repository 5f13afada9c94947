// MPI, and PETSc on it, from the start of a program to its end.
//
// Only the sources of this folder include the headers of MPI and PETSc.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// True if a launcher (mpiexec, srun) has started this process as one of its ranks. A program that nobody launched needs no
/// MPI: its start would take longer than many runs.
[[nodiscard]] bool launched_as_rank();

/// One object in a program, of which all ranks make one.
class MpiSession {
 public:
  /// Initialises MPI and PETSc. Collective. @param options of PETSc, e.g. {"-ksp_type", "cg"}; those in the environment
  /// variable PETSC_OPTIONS apply too
  /// @throws std::runtime_error on all ranks if PETSc refuses the options
  explicit MpiSession(const std::vector<std::string>& options = {});
  /// Finalises both. Collective: a rank that has met an exception must not come here, but abort().
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// All ranks.
  [[nodiscard]] Ranks& ranks() { return *ranks_; }
  /// Ends this rank and all others, which may be waiting for it. @param status of the whole program
  [[noreturn]] static void abort(int status);
  /// Options of PETSc that nothing has used so far, probably misspelt, e.g. "-ksp_tipe". Not collective.
  [[nodiscard]] static std::vector<std::string> unused_options();

 private:
  std::unique_ptr<Ranks> ranks_;
};

}  // namespace ashlar

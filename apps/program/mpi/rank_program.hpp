// The program as one of the ranks that a launcher of MPI has started. Part of builds with ASHLAR_MPI.
#pragma once

#include <string>
#include <vector>

namespace ashlar {

/// Runs the command line; the first rank writes to the standard streams. If a rank meets an error that the others do not
/// share, its message is printed, and all ranks end.
/// @param arguments without the program's name; those after --petsc are options of PETSc. @return exit status
[[nodiscard]] int run_as_rank(std::vector<std::string> arguments);

}  // namespace ashlar

// Errors of PETSc as exceptions. For sources of this folder.
#pragma once

#include <petscsys.h>

namespace ashlar {

/// @throws std::bad_alloc if PETSc found no memory, std::runtime_error with its message for other errors
void check_petsc(PetscErrorCode error);

/// Handler of PETSc's errors: keeps the message of the first one for check_petsc, and prints nothing.
PetscErrorCode keep_petsc_message(MPI_Comm comm, int line, const char* function, const char* file,
                                  PetscErrorCode error, PetscErrorType type, const char* message,
                                  void* context);

}  // namespace ashlar

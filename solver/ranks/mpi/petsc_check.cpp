#include "solver/ranks/mpi/petsc_check.hpp"

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace ashlar {
namespace {

/// Of the error that is on its way through PETSc's functions.
std::string& petsc_message() {
  static std::string message;
  return message;
}

}  // namespace

PetscErrorCode keep_petsc_message(MPI_Comm /*comm*/, int /*line*/, const char* function, const char* /*file*/,
                                  PetscErrorCode error, PetscErrorType type, const char* message,
                                  void* /*context*/) {
  if (type == PETSC_ERROR_INITIAL)
    petsc_message() = std::string(function) + ": " + (message != nullptr ? message : "");
  return error;
}

void check_petsc(PetscErrorCode error) {
  if (error == 0) return;
  const std::string message = std::exchange(petsc_message(), {});
  if (error == PETSC_ERR_MEM) throw std::bad_alloc();
  const char* kind = nullptr;
  if (PetscErrorMessage(error, &kind, nullptr) != 0 || kind == nullptr) kind = "unknown error";
  throw std::runtime_error(std::string("PETSc: ") + kind + (message.empty() ? "" : ", in " + message));
}

}  // namespace ashlar

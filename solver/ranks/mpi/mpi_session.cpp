#include "solver/ranks/mpi/mpi_session.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <array>
#include <cstdlib>

#include "solver/ranks/mpi/mpi_ranks.hpp"
#include "solver/ranks/mpi/petsc_check.hpp"
#include "solver/system/environment.hpp"

// As for CHOLMOD: a rank is one process of several on a machine, and sums must not depend on its cores.
extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));

namespace ashlar {

bool launched_as_rank() {
  // Open MPI; MPICH and Intel MPI; Slurm with either interface.
  constexpr std::array names = {"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMI_SIZE", "PMIX_RANK"};
  for (const char* name : names)
    if (std::getenv(name) != nullptr) return true;
  return false;
}

MpiSession::MpiSession(const std::vector<std::string>& options) {
  int provided = 0;
  // The threads of a rank compute; one of them communicates.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  ranks_ = make_mpi_ranks();
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  // Scotch's partitions, and orderings of MUMPS by it, depend on its threads: one for each core it sees, if not told.
  set_environment("SCOTCH_PTHREAD_NUMBER", "1");
  // Signals are the program's, which saves a state and ends.
  std::vector<std::string> words = {"ashlar", "-no_signal_handler"};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int count = static_cast<int>(words.size());
  char** arguments = pointers.data();
  check_petsc(PetscInitialize(&count, &arguments, nullptr, nullptr));
  check_petsc(PetscPushErrorHandler(keep_petsc_message, nullptr));
}

MpiSession::~MpiSession() {
  (void)PetscOptionsSetValue(nullptr, "-options_left", "no");
  (void)PetscFinalize();
  ranks_.reset();
  MPI_Finalize();
}

void MpiSession::abort(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort();
}

std::vector<std::string> MpiSession::unused_options() {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  check_petsc(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  std::vector<std::string> unused;
  unused.reserve(static_cast<std::size_t>(count));
  for (PetscInt k = 0; k < count; ++k) unused.push_back(std::string("-") + names[k]);
  check_petsc(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
  return unused;
}

}  // namespace ashlar

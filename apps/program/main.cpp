// The program `ashlar`; see command_line.hpp.
#include <fcntl.h>

#include <iostream>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"
#include "apps/program/program_memory.hpp"
#ifdef ASHLAR_MPI
#include "apps/program/mpi/rank_program.hpp"
#include "solver/ranks/mpi/mpi_session.hpp"
#endif

namespace {

/// If the caller has closed a standard stream, its number would be reused for the first opened file, and messages
/// would be written into it.
void open_closed_streams() {
  for (const int stream : {0, 1, 2})
    if (fcntl(stream, F_GETFD) == -1) (void)open("/dev/null", O_RDWR);
}

}  // namespace

int main(int count, char** arguments) {
  ashlar::prepare_for_missing_memory();
  open_closed_streams();
  const std::vector<std::string> words(arguments + 1, arguments + count);
#ifdef ASHLAR_MPI
  if (ashlar::launched_as_rank()) return ashlar::run_as_rank(words);
#endif
  return ashlar::run_command_line(words, std::cout, std::cerr);
}

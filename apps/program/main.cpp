// The program `ashlar`; see command_line.hpp.
#include <iostream>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"
#include "apps/program/program_memory.hpp"
#include "apps/results/system/this_process.hpp"
#ifdef ASHLAR_MPI
#include "apps/program/mpi/rank_program.hpp"
#include "solver/ranks/mpi/mpi_session.hpp"
#endif

int main(int count, char** arguments) {
  ashlar::prepare_for_missing_memory();
  ashlar::prepare_streams();
  const std::vector<std::string> words = ashlar::command_words(count, arguments);
#ifdef ASHLAR_MPI
  if (ashlar::launched_as_rank()) return ashlar::run_as_rank(words);
#endif
  return ashlar::run_command_line(words, std::cout, std::cerr);
}

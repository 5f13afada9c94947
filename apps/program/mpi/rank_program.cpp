#include "apps/program/mpi/rank_program.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <new>
#include <streambuf>
#include <string_view>
#include <thread>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/program/program_memory.hpp"
#include "apps/scene/assemble/run_ranks.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "solver/ranks/mpi/contact_partition.hpp"
#include "solver/ranks/mpi/mpi_session.hpp"
#include "solver/ranks/mpi/petsc_solver.hpp"

namespace ashlar {
namespace {

/// Takes what ranks other than the first would say.
class Nowhere final : public std::streambuf {
 protected:
  int_type overflow(int_type letter) override { return traits_type::not_eof(letter); }
  std::streamsize xsputn(const char*, std::streamsize count) override { return count; }
};

/// Removes the options of PETSc from the arguments.
std::vector<std::string> petsc_options(std::vector<std::string>& arguments) {
  const auto mark = std::find(arguments.begin(), arguments.end(), "--petsc");
  if (mark == arguments.end()) return {};
  std::vector<std::string> options(mark + 1, arguments.end());
  arguments.erase(mark, arguments.end());
  return options;
}

/// All ranks may meet the same error: the first one tells it, and ends the others while they wait.
[[noreturn]] void end_all(int rank, std::string_view fault) {
  std::this_thread::sleep_for(std::min(rank, 20) * std::chrono::milliseconds(250));
  std::cerr << "ashlar: error: " << (rank > 0 ? "rank " + std::to_string(rank) + ": " : "") << fault
            << std::endl;
  MpiSession::abort(exit_status::failed);
}

void tell_unused(const std::vector<std::string>& given) {
  for (const std::string& option : MpiSession::unused_options())
    if (std::find(given.begin(), given.end(), option) != given.end())
      std::cerr << "ashlar: warning: nothing has used the option " << option << " of PETSc\n";
}

}  // namespace

int run_as_rank(std::vector<std::string> arguments) {
  const std::vector<std::string> options = petsc_options(arguments);
  MpiSession session(options);
  Ranks& ranks = session.ranks();
  const RunRanks shared{ranks, partition_by_contact, [](Ranks& all) { return make_petsc_solver(all); }};
  Nowhere silence;
  std::ostream nowhere(&silence);
  const bool first = ranks.own() == 0;
  try {
    const int status = run_command_line(std::move(arguments), first ? std::cout : nowhere,
                                        first ? std::cerr : nowhere, &shared);
    if (first) tell_unused(options);
    return status;
  } catch (const std::bad_alloc& error) {
    end_all(ranks.own(), missing_memory(error));
  } catch (const std::exception& error) {
    end_all(ranks.own(), fault_text(error));
  }
}

}  // namespace ashlar

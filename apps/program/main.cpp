// The program `ashlar`; see command_line.hpp.
#include <iostream>
#include <string>
#include <vector>

#include "apps/program/command_line.hpp"
#include "apps/program/program_memory.hpp"
#include "apps/results/system/this_process.hpp"

int main(int count, char** arguments) {
  ashlar::prepare_for_missing_memory();
  ashlar::open_closed_streams();
  return ashlar::run_command_line(std::vector<std::string>(arguments + 1, arguments + count), std::cout,
                                  std::cerr);
}

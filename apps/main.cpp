// The program `ashlar`; see command_line.hpp.
#include <iostream>
#include <string>
#include <vector>

#include "apps/command_line.hpp"

int main(int count, char** arguments) {
  return ashlar::run_command_line(std::vector<std::string>(arguments + 1, arguments + count), std::cout,
                                  std::cerr);
}

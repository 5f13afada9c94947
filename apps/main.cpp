// The program `ashlar`; see command_line.hpp.
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "apps/command_line.hpp"

int main(int count, char** arguments) {
  try {
    return ashlar::run_command_line(std::vector<std::string>(arguments + 1, arguments + count), std::cout,
                                    std::cerr);
  } catch (const std::exception& error) {
    // No fault of the input ends here; what does is the program's own failure.
    std::cerr << "ashlar: error: " << error.what() << '\n';
    return ashlar::exit_status::failed;
  }
}

// The program `ashlar`; see command_line.hpp.
#include <fcntl.h>

#include <iostream>
#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/program_memory.hpp"

namespace {

/// A standard stream that the caller has closed would lend its number to the first file that is opened, and messages
/// would go into that.
void open_closed_streams() {
  for (const int stream : {0, 1, 2})
    if (fcntl(stream, F_GETFD) == -1) (void)open("/dev/null", O_RDWR);
}

}  // namespace

int main(int count, char** arguments) {
  ashlar::prepare_for_missing_memory();
  open_closed_streams();
  return ashlar::run_command_line(std::vector<std::string>(arguments + 1, arguments + count), std::cout,
                                  std::cerr);
}

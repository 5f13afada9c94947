// A page has no other programs.
#include "apps/results/system/child_program.hpp"

#include <system_error>

namespace ashlar {

bool is_executable(const std::filesystem::path& /*file*/) {
  return false;
}

std::optional<std::filesystem::path> find_program(const std::string& /*name*/) {
  return std::nullopt;
}

std::optional<int> run_program(const std::vector<std::string>& command, const std::filesystem::path& /*out*/,
                               const std::filesystem::path& /*err*/,
                               std::chrono::duration<double> /*limit*/) {
  throw std::system_error(std::make_error_code(std::errc::function_not_supported),
                          "cannot start " + command.front());
}

}  // namespace ashlar

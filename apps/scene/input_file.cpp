#include "apps/scene/input_file.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

namespace ashlar {

void require_regular_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw std::runtime_error("it is not a regular file");
}

std::string whole_file(const std::filesystem::path& path) {
  require_regular_file(path);
  std::ifstream input(path, std::ios::binary);
  if (!input) throw std::runtime_error("it cannot be opened");
  return {std::istreambuf_iterator<char>(input), {}};
}

}  // namespace ashlar

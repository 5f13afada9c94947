#include "apps/scene/toml/input_file.hpp"

#include <array>
#include <fstream>
#include <istream>
#include <system_error>

#include "geometry/text/reading_folder.hpp"

namespace ashlar {

void require_regular_file(const std::filesystem::path& path) {
  require_readable(path);
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw std::runtime_error("it is not a regular file");
}

std::string whole_file(const std::filesystem::path& path, std::size_t most) {
  require_regular_file(path);
  std::ifstream input(path, std::ios::binary);
  if (!input) throw std::runtime_error("it cannot be opened");
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > most) throw std::runtime_error(too_large(size));
  return whole_stream(input, most);
}

std::string too_large(std::uintmax_t bytes) {
  constexpr double megabyte = 1e6, gigabyte = 1e9;
  const auto size = static_cast<double>(bytes);
  const std::string found =
      size < gigabyte ? fmt::format("{:.1f} MB", size / megabyte) : fmt::format("{:.1f} GB", size / gigabyte);
  return fmt::format("too large ({}), at most {} MB are allowed", found,
                     static_cast<double>(most_input_bytes) / megabyte);
}

std::string whole_stream(std::istream& input, std::size_t most) {
  // Stream operators swallow exceptions, including failed allocations, and a partial content would seem complete.
  std::string bytes;
  std::array<char, 1 << 16> part{};
  while (input.read(part.data(), part.size()) || input.gcount() > 0) {
    const auto count = static_cast<std::size_t>(input.gcount());
    if (count > most - bytes.size()) throw std::runtime_error(too_large(bytes.size() + count));
    bytes.append(part.data(), count);
  }
  if (input.bad()) throw std::runtime_error("it cannot be read");
  return bytes;
}

}  // namespace ashlar

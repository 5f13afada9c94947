#include "apps/results/system/named_file.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <system_error>

namespace ashlar {

NamedFile named_file(const std::filesystem::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot find " + path.string());
  return {.device = status.st_dev,
          .number = status.st_ino,
          .bytes = static_cast<std::uint64_t>(status.st_size),
          .is_plain = S_ISREG(status.st_mode),
          .is_folder = S_ISDIR(status.st_mode)};
}

}  // namespace ashlar

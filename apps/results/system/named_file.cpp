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

std::vector<std::filesystem::path> names_in(const std::filesystem::path& folder) {
  std::error_code reason;
  std::vector<std::filesystem::path> names;
  for (auto entry = std::filesystem::directory_iterator(folder, reason);
       !reason && entry != std::filesystem::directory_iterator(); entry.increment(reason))
    names.push_back(entry->path().filename());
  if (reason) throw std::system_error(reason, "cannot read folder " + folder.string());
  return names;
}

}  // namespace ashlar

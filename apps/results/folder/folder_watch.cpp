#include "apps/results/folder/folder_watch.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace ashlar {

/// Status of the folder itself, not of a link's target.
static struct stat status_of_folder(const std::filesystem::path& folder) {
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot find " + folder.string());
  if (!S_ISDIR(status.st_mode))
    throw std::system_error(std::make_error_code(std::errc::not_a_directory),
                            "cannot write into " + folder.string());
  return status;
}

FolderWatch::FolderWatch(std::filesystem::path folder) : folder_(std::move(folder)) {
  const struct stat status = status_of_folder(folder_);
  device_ = status.st_dev;
  number_ = status.st_ino;
}

void FolderWatch::check() const {
  const struct stat status = status_of_folder(folder_);
  if (status.st_dev == device_ && status.st_ino == number_) return;
  throw std::system_error(std::make_error_code(std::errc::no_such_file_or_directory),
                          folder_.string() + " was replaced while files were being written into it");
}

}  // namespace ashlar

#include "apps/results/folder/folder_watch.hpp"

#include <system_error>
#include <utility>

namespace ashlar {

static NamedFile known_folder(const std::filesystem::path& folder) {
  const NamedFile found = named_file(folder);
  if (!found.is_folder)
    throw std::system_error(std::make_error_code(std::errc::not_a_directory),
                            "cannot write into " + folder.string());
  return found;
}

FolderWatch::FolderWatch(std::filesystem::path folder)
    : folder_(std::move(folder)), known_(known_folder(folder_)) {}

void FolderWatch::check() const {
  if (known_folder(folder_).is_same_as(known_)) return;
  throw std::system_error(std::make_error_code(std::errc::no_such_file_or_directory),
                          folder_.string() + " was replaced while files were being written into it");
}

}  // namespace ashlar

#include "geometry/text/reading_folder.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>

namespace ashlar {
namespace {

std::vector<std::filesystem::path>& reading_folders() {
  static std::vector<std::filesystem::path> folders;
  return folders;
}

}  // namespace

void limit_reading_to(const std::vector<std::filesystem::path>& folders) {
  reading_folders().clear();
  for (const std::filesystem::path& folder : folders)
    reading_folders().push_back(std::filesystem::canonical(folder));
}

bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code fault;
  const std::filesystem::path absolute = std::filesystem::absolute(file, fault);
  if (fault) return false;
  const std::filesystem::path real = std::filesystem::weakly_canonical(absolute, fault);
  if (fault) return false;
  return std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first == folder.end();
}

std::string refusal_to_read(const std::filesystem::path& file) {
  const std::vector<std::filesystem::path>& folders = reading_folders();
  if (folders.empty() ||
      std::any_of(folders.begin(), folders.end(),
                  [&](const std::filesystem::path& folder) { return is_below(file, folder); }))
    return "";
  return "outside of the folder " + folders.front().string() + ", only files below it are read";
}

void require_readable(const std::filesystem::path& file) {
  if (const std::string refusal = refusal_to_read(file); !refusal.empty())
    throw std::runtime_error("it is " + refusal);
}

}  // namespace ashlar

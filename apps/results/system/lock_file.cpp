#include "apps/results/system/lock_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace ashlar {
namespace {

std::error_code last_reason_of_system() {
  return {errno, std::generic_category()};
}

}  // namespace

LockFile::~LockFile() {
  close();
}

std::error_code LockFile::open(const std::filesystem::path& path, Start start) {
  close();
  constexpr int safe = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  descriptor_ = start == Start::existing ? ::open(path.c_str(), safe)
                                         : ::open(path.c_str(), safe | O_CREAT | O_EXCL, 0666);
  return descriptor_ < 0 ? last_reason_of_system() : std::error_code();
}

void LockFile::close() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

std::error_code LockFile::lock() {
  while (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
    if (errno != EINTR) return last_reason_of_system();
  return {};
}

std::error_code LockFile::find_kind(bool& plain, std::uint64_t& bytes) const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) return last_reason_of_system();
  plain = S_ISREG(status.st_mode);
  bytes = static_cast<std::uint64_t>(status.st_size);
  return {};
}

bool LockFile::is_at(const std::filesystem::path& path) const {
  struct stat named {};
  struct stat held {};
  return ::lstat(path.c_str(), &named) == 0 && ::fstat(descriptor_, &held) == 0 &&
         named.st_dev == held.st_dev && named.st_ino == held.st_ino;
}

std::string LockFile::start(std::size_t bytes) const {
  std::string text(bytes, '\0');
  const ssize_t size = ::pread(descriptor_, text.data(), bytes, 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

std::error_code LockFile::replace(std::string_view content) {
  if (::pwrite(descriptor_, content.data(), content.size(), 0) != static_cast<ssize_t>(content.size()) ||
      ::ftruncate(descriptor_, static_cast<off_t>(content.size())) != 0)
    return last_reason_of_system();
  return {};
}

}  // namespace ashlar

#include "apps/results/system/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace ashlar {

OutputFile::OutputFile(std::filesystem::path path, Start start) : path_(std::move(path)) {
  const int mode = start == Start::created ? O_CREAT | O_EXCL : start == Start::empty ? O_CREAT | O_TRUNC : 0;
  // O_NONBLOCK: opening a pipe does not wait for a reader; no effect on other files.
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | mode, 0666);
  if (descriptor_ < 0) fail("open");
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || S_ISFIFO(status.st_mode)) {
    const int reason = S_ISFIFO(status.st_mode) ? EINVAL : errno;
    ::close(std::exchange(descriptor_, -1));
    errno = reason;
    fail("open");
  }
  const off_t end = ::lseek(descriptor_, 0, SEEK_END);
  // A terminal has no position and starts empty.
  size_ = end < 0 ? 0 : static_cast<std::uintmax_t>(end);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

void OutputFile::write(std::string_view bytes) {
  std::string_view left = bytes;
  while (!left.empty()) {
    const ssize_t written = ::write(descriptor_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      if (::ftruncate(descriptor_, static_cast<off_t>(size_)) == 0) {
        ::lseek(descriptor_, static_cast<off_t>(size_), SEEK_SET);
      }
      errno = reason;
      fail("write");
    }
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ += bytes.size();
}

void OutputFile::truncate(std::uintmax_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail("truncate");
  if (::lseek(descriptor_, static_cast<off_t>(size), SEEK_SET) < 0) fail("truncate");
  size_ = size;
}

void OutputFile::sync() {
  if (::fsync(descriptor_) != 0) fail("write");
}

void OutputFile::check_in_place() const {
  struct stat named {};
  struct stat held {};
  if (::lstat(path_.c_str(), &named) != 0) fail("find");
  if (::fstat(descriptor_, &held) != 0) fail("find");
  if (named.st_dev != held.st_dev || named.st_ino != held.st_ino)
    throw std::system_error(std::make_error_code(std::errc::no_such_file_or_directory),
                            path_.string() + " was replaced while it was being written");
  if (!S_ISREG(held.st_mode) || static_cast<std::uintmax_t>(held.st_size) == size_) return;
  throw std::runtime_error(path_.string() + " was changed by others while it was being written: it has " +
                           std::to_string(held.st_size) + " bytes, " + std::to_string(size_) +
                           " were written");
}

void OutputFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("write");
}

void OutputFile::fail(const char* action) const {
  throw std::system_error(errno, std::generic_category(),
                          std::string("cannot ") + action + " " + path_.string());
}

bool is_fault_of_device(const std::error_code& reason) {
  constexpr std::array faults = {std::errc::no_space_on_device, std::errc::io_error,
                                 std::errc::file_too_large, std::errc::too_many_files_open,
                                 std::errc::too_many_files_open_in_system};
  return reason == std::error_code(EDQUOT, std::generic_category()) ||
         std::any_of(faults.begin(), faults.end(), [&](std::errc fault) { return reason == fault; });
}

void rename_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::rename(from, to);
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  // Some file systems cannot sync a folder and return EINVAL; nothing more can be done on them.
  if (!synced && reason != EINVAL) {
    throw std::system_error(reason, std::generic_category(), "cannot write folder " + folder.string());
  }
}

}  // namespace ashlar

#include "apps/results/system/output_file.hpp"

#include <io.h>
#include <windows.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "apps/results/system/named_file.hpp"
#include "apps/results/system/windows/open_file.hpp"

namespace ashlar {
namespace {

[[noreturn]] void throw_fault(const char* action, const std::filesystem::path& path,
                              const std::error_code& reason) {
  throw std::system_error(reason, std::string("cannot ") + action + " " + path.string());
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, Start start) : path_(std::move(path)) {
  const DWORD creation = start == Start::created ? CREATE_NEW
                         : start == Start::empty ? CREATE_ALWAYS
                                                 : OPEN_EXISTING;
  std::error_code reason;
  descriptor_ = open_descriptor(path_, GENERIC_WRITE | FILE_READ_ATTRIBUTES, creation, reason);
  if (descriptor_ < 0) throw_fault("open", path_, reason);
  if (::GetFileType(handle_of(descriptor_)) == FILE_TYPE_PIPE) {
    ::_close(std::exchange(descriptor_, -1));
    throw_fault("open", path_, std::make_error_code(std::errc::invalid_argument));
  }
  const std::int64_t end = ::_lseeki64(descriptor_, 0, SEEK_END);
  // A console has no position and starts empty.
  size_ = end < 0 ? 0 : static_cast<std::uintmax_t>(end);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::_close(descriptor_);
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
  constexpr std::size_t most = std::size_t{1} << 30U;  // a call takes 32 bits
  std::string_view left = bytes;
  while (!left.empty()) {
    DWORD written = 0;
    const auto part = static_cast<DWORD>(std::min(left.size(), most));
    if (::WriteFile(handle_of(descriptor_), left.data(), part, &written, nullptr) == 0 || written == 0) {
      const std::error_code reason = reason_of_windows();
      if (::_chsize_s(descriptor_, static_cast<std::int64_t>(size_)) == 0)
        ::_lseeki64(descriptor_, static_cast<std::int64_t>(size_), SEEK_SET);
      throw_fault("write", path_, reason);
    }
    left.remove_prefix(written);
  }
  size_ += bytes.size();
}

void OutputFile::truncate(std::uintmax_t size) {
  errno = ::_chsize_s(descriptor_, static_cast<std::int64_t>(size));
  if (errno != 0 || ::_lseeki64(descriptor_, static_cast<std::int64_t>(size), SEEK_SET) < 0) fail("truncate");
  size_ = size;
}

void OutputFile::sync() {
  if (::FlushFileBuffers(handle_of(descriptor_)) == 0) throw_fault("write", path_, reason_of_windows());
}

void OutputFile::check_in_place() const {
  const NamedFile named = named_file(path_);
  BY_HANDLE_FILE_INFORMATION held{};
  if (::GetFileInformationByHandle(handle_of(descriptor_), &held) == 0)
    throw_fault("find", path_, reason_of_windows());
  const std::uint64_t number = (std::uint64_t{held.nFileIndexHigh} << 32U) | held.nFileIndexLow;
  if (named.device != held.dwVolumeSerialNumber || named.number != number)
    throw std::system_error(std::make_error_code(std::errc::no_such_file_or_directory),
                            path_.string() + " was replaced while it was being written");
  const std::uint64_t bytes = (std::uint64_t{held.nFileSizeHigh} << 32U) | held.nFileSizeLow;
  if (!named.is_plain || bytes == size_) return;
  throw std::runtime_error(path_.string() + " was changed by others while it was being written: it has " +
                           std::to_string(bytes) + " bytes, " + std::to_string(size_) + " were written");
}

void OutputFile::close() {
  if (::_close(std::exchange(descriptor_, -1)) != 0) fail("write");
}

void OutputFile::fail(const char* action) const {
  throw_fault(action, path_, {errno, std::generic_category()});
}

bool is_fault_of_device(const std::error_code& reason) {
  constexpr std::array faults = {std::errc::no_space_on_device, std::errc::io_error,
                                 std::errc::file_too_large, std::errc::too_many_files_open,
                                 std::errc::too_many_files_open_in_system};
  constexpr int quota_exceeded = 1295;  // of Windows; headers of MinGW have no name for it
  return reason == std::error_code(quota_exceeded, std::system_category()) ||
         std::any_of(faults.begin(), faults.end(), [&](std::errc fault) { return reason == fault; });
}

void rename_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  constexpr int tries = 40;
  constexpr std::chrono::milliseconds pause(50);
  std::error_code reason;
  for (int k = 0; k < tries; ++k) {
    std::filesystem::rename(from, to, reason);
    if (reason != std::errc::permission_denied) break;
    std::this_thread::sleep_for(pause);
  }
  if (reason) throw std::filesystem::filesystem_error("cannot rename", from, to, reason);
}

// The file system writes changes of folders to its journal by itself, and offers no call that waits for it.
void sync_folder(const std::filesystem::path& folder) {
  if (!folder.empty()) (void)named_file(folder);
}

}  // namespace ashlar

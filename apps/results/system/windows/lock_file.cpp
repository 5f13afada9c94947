#include "apps/results/system/lock_file.hpp"

#include <io.h>
#include <windows.h>

#include <utility>

#include "apps/results/system/named_file.hpp"
#include "apps/results/system/windows/open_file.hpp"

namespace ashlar {
namespace {

/// The bytes that are locked are far behind the content: others may read who has the lock.
constexpr DWORD locked_place = 0x40000000;  // times 2^32

bool find_by_handle(int descriptor, BY_HANDLE_FILE_INFORMATION& found) {
  return ::GetFileInformationByHandle(handle_of(descriptor), &found) != 0;
}

}  // namespace

LockFile::~LockFile() {
  close();
}

std::error_code LockFile::open(const std::filesystem::path& path, Start start) {
  close();
  std::error_code reason;
  descriptor_ = open_descriptor(path, GENERIC_READ | GENERIC_WRITE,
                                start == Start::existing ? OPEN_EXISTING : CREATE_NEW, reason);
  return reason;
}

void LockFile::close() {
  if (descriptor_ >= 0) ::_close(std::exchange(descriptor_, -1));
}

std::error_code LockFile::lock() {
  OVERLAPPED place{};
  place.OffsetHigh = locked_place;
  if (::LockFileEx(handle_of(descriptor_), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0,
                   &place) != 0)
    return {};
  const DWORD reason = ::GetLastError();
  return reason == ERROR_LOCK_VIOLATION || reason == ERROR_IO_PENDING
             ? std::make_error_code(std::errc::resource_unavailable_try_again)
             : reason_of_windows();
}

std::error_code LockFile::find_kind(bool& plain, std::uint64_t& bytes) const {
  BY_HANDLE_FILE_INFORMATION found{};
  if (!find_by_handle(descriptor_, found)) return reason_of_windows();
  plain = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0 &&
          ::GetFileType(handle_of(descriptor_)) == FILE_TYPE_DISK;
  bytes = (std::uint64_t{found.nFileSizeHigh} << 32U) | found.nFileSizeLow;
  return {};
}

bool LockFile::is_at(const std::filesystem::path& path) const {
  BY_HANDLE_FILE_INFORMATION held{};
  if (!find_by_handle(descriptor_, held)) return false;
  try {
    const NamedFile named = named_file(path);
    return named.device == held.dwVolumeSerialNumber &&
           named.number == ((std::uint64_t{held.nFileIndexHigh} << 32U) | held.nFileIndexLow);
  } catch (const std::system_error&) {
    return false;
  }
}

std::string LockFile::start(std::size_t bytes) const {
  std::string text(bytes, '\0');
  OVERLAPPED place{};
  DWORD size = 0;
  if (::ReadFile(handle_of(descriptor_), text.data(), static_cast<DWORD>(bytes), &size, &place) == 0)
    size = 0;
  text.resize(size);
  return text;
}

std::error_code LockFile::replace(std::string_view content) {
  OVERLAPPED place{};
  DWORD written = 0;
  if (::WriteFile(handle_of(descriptor_), content.data(), static_cast<DWORD>(content.size()), &written,
                  &place) == 0 ||
      written != content.size())
    return reason_of_windows();
  const int failed = ::_chsize_s(descriptor_, static_cast<std::int64_t>(content.size()));
  return failed == 0 ? std::error_code() : std::error_code(failed, std::generic_category());
}

}  // namespace ashlar

#include "apps/results/system/named_file.hpp"

#include <io.h>
#include <windows.h>

#include <string>
#include <system_error>

#include "apps/results/system/windows/open_file.hpp"

namespace ashlar {

NamedFile named_file(const std::filesystem::path& path) {
  std::error_code reason;
  const int descriptor = open_descriptor(path, 0, OPEN_EXISTING, reason);
  if (descriptor < 0) throw std::system_error(reason, "cannot find " + path.string());
  BY_HANDLE_FILE_INFORMATION found{};
  const bool good = ::GetFileInformationByHandle(handle_of(descriptor), &found) != 0;
  if (!good) reason = reason_of_windows();
  const bool is_disk = ::GetFileType(handle_of(descriptor)) == FILE_TYPE_DISK;
  ::_close(descriptor);
  // A device, e.g. NUL, has no number.
  if (!good && is_disk) throw std::system_error(reason, "cannot find " + path.string());
  const bool is_link = (found.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
  const bool is_folder = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  return {.device = found.dwVolumeSerialNumber,
          .number = (std::uint64_t{found.nFileIndexHigh} << 32U) | found.nFileIndexLow,
          .bytes = (std::uint64_t{found.nFileSizeHigh} << 32U) | found.nFileSizeLow,
          .is_plain = is_disk && !is_folder && !is_link,
          .is_folder = is_folder && !is_link};
}

// Iterators of std::filesystem, as MinGW-w64 has them, stop at 260 letters.
std::vector<std::filesystem::path> names_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> names;
  WIN32_FIND_DATAW found{};
  const HANDLE search = ::FindFirstFileW(name_for_windows(folder / L"*").c_str(), &found);
  bool more = search != INVALID_HANDLE_VALUE;
  while (more) {
    const std::wstring name = found.cFileName;
    if (name != L"." && name != L"..") names.emplace_back(name);
    more = ::FindNextFileW(search, &found) != 0;
  }
  const DWORD end = ::GetLastError();
  const std::error_code reason = reason_of_windows();
  if (search != INVALID_HANDLE_VALUE) ::FindClose(search);
  if (end != ERROR_NO_MORE_FILES && end != ERROR_FILE_NOT_FOUND)
    throw std::system_error(reason, "cannot read folder " + folder.string());
  return names;
}

}  // namespace ashlar

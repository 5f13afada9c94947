#include "apps/results/system/windows/open_file.hpp"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cstdint>

namespace ashlar {
namespace {

/// Windows refuses longer paths without the prefix; a folder's is 12 shorter than a file's.
constexpr std::size_t longest_plain_path = MAX_PATH - 13;

HANDLE opened(const std::wstring& name, DWORD access, DWORD creation, DWORD flags) {
  constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  return ::CreateFileW(name.c_str(), access, shared, nullptr, creation, flags | FILE_ATTRIBUTE_NORMAL,
                       nullptr);
}

/// True for symbolic links and junctions; other reparse points are files, e.g. those of a cloud's folder.
bool is_link(HANDLE file, bool& is_reparse_point) {
  FILE_ATTRIBUTE_TAG_INFO tag{};
  if (::GetFileInformationByHandleEx(file, FileAttributeTagInfo, &tag, sizeof tag) == 0) return false;
  is_reparse_point = (tag.FileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
  return is_reparse_point && IsReparseTagNameSurrogate(tag.ReparseTag);
}

bool is_folder(const std::wstring& name) {
  const DWORD attributes = ::GetFileAttributesW(name.c_str());
  return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

}  // namespace

std::error_code reason_of_windows() {
  const std::error_code reason(static_cast<int>(::GetLastError()), std::system_category());
  const std::error_condition portable = reason.default_error_condition();
  return portable.category() == std::generic_category()
             ? std::error_code(portable.value(), std::generic_category())
             : reason;
}

std::wstring name_for_windows(const std::filesystem::path& path) {
  const std::wstring& given = path.native();
  if (given.starts_with(LR"(\\?\)") || given.starts_with(LR"(\\.\)")) return given;
  const DWORD size = ::GetFullPathNameW(given.c_str(), 0, nullptr, nullptr);
  if (size <= longest_plain_path) return given;
  std::wstring full(size, L'\0');
  full.resize(::GetFullPathNameW(given.c_str(), size, full.data(), nullptr));
  return full.starts_with(LR"(\\)") ? LR"(\\?\UNC\)" + full.substr(2) : LR"(\\?\)" + full;
}

int open_descriptor(const std::filesystem::path& path, unsigned long access, unsigned long creation,
                    std::error_code& reason) {
  const std::wstring name = name_for_windows(path);
  const bool empties = creation == CREATE_ALWAYS || creation == TRUNCATE_EXISTING;
  const DWORD how = creation == CREATE_ALWAYS ? OPEN_ALWAYS : empties ? OPEN_EXISTING : creation;
  const DWORD folders = access == 0 ? FILE_FLAG_BACKUP_SEMANTICS : 0;
  HANDLE file = opened(name, access, how, folders | FILE_FLAG_OPEN_REPARSE_POINT);
  if (file == INVALID_HANDLE_VALUE) {
    reason = access != 0 && is_folder(name) ? std::make_error_code(std::errc::is_a_directory)
                                            : reason_of_windows();
    return -1;
  }
  bool is_reparse_point = false;
  if (access != 0 && is_link(file, is_reparse_point)) {
    ::CloseHandle(file);
    reason = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    return -1;
  }
  if (is_reparse_point) {
    ::CloseHandle(file);
    file = opened(name, access, OPEN_EXISTING, 0);
  }
  if (file == INVALID_HANDLE_VALUE || (empties && ::SetEndOfFile(file) == 0)) {
    reason = reason_of_windows();
    if (file != INVALID_HANDLE_VALUE) ::CloseHandle(file);
    return -1;
  }
  reason.clear();
  return ::_open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_BINARY | _O_NOINHERIT);
}

void* handle_of(int descriptor) {
  return reinterpret_cast<void*>(::_get_osfhandle(descriptor));
}

std::wstring wide_text(std::string_view utf8) {
  const int bytes = static_cast<int>(utf8.size());
  std::wstring wide(
      static_cast<std::size_t>(::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), bytes, nullptr, 0)), L'\0');
  ::MultiByteToWideChar(CP_UTF8, 0, utf8.data(), bytes, wide.data(), static_cast<int>(wide.size()));
  return wide;
}

std::string utf8_text(std::wstring_view wide) {
  const int letters = static_cast<int>(wide.size());
  std::string utf8(static_cast<std::size_t>(
                       ::WideCharToMultiByte(CP_UTF8, 0, wide.data(), letters, nullptr, 0, nullptr, nullptr)),
                   '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, wide.data(), letters, utf8.data(), static_cast<int>(utf8.size()), nullptr,
                        nullptr);
  return utf8;
}

}  // namespace ashlar

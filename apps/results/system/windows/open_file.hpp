// Files of Windows as descriptors of the C library: opened so that others may rename and remove them, as elsewhere, and
// with long paths.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace ashlar {

/// The reason of the last call of Windows that failed, as that of POSIX where there is one.
[[nodiscard]] std::error_code reason_of_windows();

/// A path that Windows opens whatever its length: absolute and with the prefix \\?\ if it is long.
[[nodiscard]] std::wstring name_for_windows(const std::filesystem::path& path);

/// @param access GENERIC_READ, GENERIC_WRITE or both; 0: its attributes only, also of a folder or of a link itself
/// @param creation CREATE_NEW and the like; a link is not followed, and never emptied or replaced
/// @return a descriptor, binary and not passed to child processes; or -1, with the reason
[[nodiscard]] int open_descriptor(const std::filesystem::path& path, unsigned long access,
                                  unsigned long creation, std::error_code& reason);

/// Handle of an open descriptor.
[[nodiscard]] void* handle_of(int descriptor);

[[nodiscard]] std::wstring wide_text(std::string_view utf8);
[[nodiscard]] std::string utf8_text(std::wstring_view wide);

}  // namespace ashlar

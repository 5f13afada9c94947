#include "apps/results/system/space_reserve.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <windows.h>

#include <cerrno>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>

#include "apps/results/system/this_process.hpp"
#include "apps/results/system/windows/open_file.hpp"

namespace ashlar {

SpaceReserve::SpaceReserve(std::filesystem::path folder) : folder_(std::move(folder)) {}

SpaceReserve::~SpaceReserve() {
  release();
}

void SpaceReserve::hold(std::uintmax_t bytes) {
  if (bytes <= held_) return;
  if (descriptor_ < 0) {
    // Windows removes it with its only handle; until then it has a name.
    const std::wstring name =
        name_for_windows(folder_ / fmt::format("reserve-{}-{}", process_number(), ::GetTickCount64()));
    const HANDLE file =
        ::CreateFileW(name.c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_DELETE, nullptr, CREATE_NEW,
                      FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (file == INVALID_HANDLE_VALUE) fail(bytes, reason_of_windows().value());
    descriptor_ = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_BINARY | _O_NOINHERIT);
  }
  // The file system allocates all clusters of a file that is not sparse.
  if (const int reason = ::_chsize_s(descriptor_, static_cast<std::int64_t>(bytes)); reason != 0)
    fail(bytes, reason);
  held_ = bytes;
}

void SpaceReserve::release() noexcept {
  if (descriptor_ >= 0) ::_close(std::exchange(descriptor_, -1));
  held_ = 0;
}

void SpaceReserve::fail(std::uintmax_t bytes, int reason) const {
  throw std::system_error(reason, std::generic_category(),
                          fmt::format("cannot keep {} bytes free in {}", bytes, folder_.string()));
}

}  // namespace ashlar

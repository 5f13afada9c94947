#include "apps/results/system/space_reserve.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace ashlar {

SpaceReserve::SpaceReserve(std::filesystem::path folder) : folder_(std::move(folder)) {}

SpaceReserve::~SpaceReserve() {
  release();
}

void SpaceReserve::hold(std::uintmax_t bytes) {
  if (bytes <= held_) return;
  if (descriptor_ < 0) {
    std::string name = (folder_ / "reserve-XXXXXX").string();
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail(bytes, errno);
    (void)::unlink(name.c_str());
  }
  int reason = 0;
  do {
    reason = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
  } while (reason == EINTR);
  if (reason != 0) fail(bytes, reason);
  held_ = bytes;
}

void SpaceReserve::release() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  held_ = 0;
}

void SpaceReserve::fail(std::uintmax_t bytes, int reason) const {
  throw std::system_error(reason, std::generic_category(),
                          fmt::format("cannot keep {} bytes free in {}", bytes, folder_.string()));
}

}  // namespace ashlar

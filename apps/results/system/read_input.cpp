#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "apps/results/system/input_lines.hpp"

namespace ashlar {

void InputLines::wait(std::chrono::milliseconds most) {
  if (closed_) return;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::poll(&input, 1, static_cast<int>(most.count())) <= 0) return;
  std::array<char, 1 << 16> part{};
  const ssize_t size = ::read(STDIN_FILENO, part.data(), part.size());
  if (size < 0 && (errno == EINTR || errno == EAGAIN)) return;
  if (size <= 0)
    closed_ = true;
  else
    text_.append(part.data(), static_cast<std::size_t>(size));
}

}  // namespace ashlar

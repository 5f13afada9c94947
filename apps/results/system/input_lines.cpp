#include "apps/results/system/input_lines.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

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

std::optional<InputLine> InputLines::next() {
  const std::size_t end = text_.find('\n', searched_);
  const bool complete = end != std::string::npos;
  if (!complete && !closed_) {
    searched_ = text_.size();
    if (searched_ > longest_) {
      skips_ = true;
      text_.clear();
      searched_ = 0;
    }
    return std::nullopt;
  }
  if (!complete && text_.empty() && !skips_) return std::nullopt;
  InputLine line{text_.substr(0, end), skips_};
  text_.erase(0, complete ? end + 1 : end);
  searched_ = 0;
  skips_ = false;
  if (line.too_long || line.text.size() > longest_) line = {"", true};
  return line;
}

}  // namespace ashlar

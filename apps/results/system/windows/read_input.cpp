#include <windows.h>

#include <array>
#include <thread>

#include "apps/results/system/input_lines.hpp"

namespace ashlar {
namespace {

/// True if reading returns at once: there are bytes, or the input has ended.
bool has_input(HANDLE input) {
  if (::GetFileType(input) != FILE_TYPE_PIPE) return ::WaitForSingleObject(input, 0) != WAIT_TIMEOUT;
  DWORD bytes = 0;
  return ::PeekNamedPipe(input, nullptr, 0, nullptr, &bytes, nullptr) == 0 || bytes > 0;
}

}  // namespace

void InputLines::wait(std::chrono::milliseconds most) {
  if (closed_) return;
  constexpr std::chrono::milliseconds pause(5);
  const auto end = std::chrono::steady_clock::now() + most;
  const HANDLE input = ::GetStdHandle(STD_INPUT_HANDLE);
  while (!has_input(input)) {
    if (std::chrono::steady_clock::now() >= end) return;
    std::this_thread::sleep_for(pause);
  }
  std::array<char, 1 << 16> part{};
  DWORD size = 0;
  if (::ReadFile(input, part.data(), static_cast<DWORD>(part.size()), &size, nullptr) == 0 || size == 0)
    closed_ = true;
  else
    text_.append(part.data(), size);
}

}  // namespace ashlar

#include "apps/results/system/interrupt_guard.hpp"

#include <windows.h>

#include <atomic>
#include <mutex>
#include <string_view>

#include "apps/results/system/this_process.hpp"

namespace ashlar {
namespace {

/// ms. Requests this close are one.
constexpr ULONGLONG one_request = 250;
/// ms between looks whether the run has ended; and the time after which Windows ends the program in any case.
constexpr DWORD pause = 50;

std::atomic<bool> stop_wanted = false;
std::atomic<bool> on_terminal = false;
std::atomic<ULONGLONG> first_request = 0;  ///< ms since the start of the system
std::atomic<int> guard_count = 0;

std::mutex& guard_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Called by Windows in a thread of its own. @return FALSE: the program is ended
BOOL WINAPI on_request(DWORD kind) {
  const ULONGLONG now = ::GetTickCount64();
  const bool is_first = !stop_wanted.exchange(true);
  if (is_first) first_request = now;
  if (kind == CTRL_CLOSE_EVENT || kind == CTRL_LOGOFF_EVENT || kind == CTRL_SHUTDOWN_EVENT) {
    // Windows ends the program when this returns, or after some seconds: the state is saved until then.
    while (guard_count > 0) ::Sleep(pause);
    return FALSE;
  }
  if (is_first) {
    constexpr std::string_view note = "\nstopping after this step; Ctrl-C once more ends at once, unsaved\n";
    if (on_terminal) write_to_errors(note);
    return TRUE;
  }
  return now - first_request < one_request ? TRUE : FALSE;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  const std::lock_guard lock(guard_mutex());
  if (guard_count++ > 0) return;
  stop_wanted = false;
  on_terminal = errors_go_to_a_terminal();
  ::SetConsoleCtrlHandler(on_request, TRUE);
}

InterruptGuard::~InterruptGuard() {
  const std::lock_guard lock(guard_mutex());
  if (--guard_count > 0) return;
  ::SetConsoleCtrlHandler(on_request, FALSE);
}

bool InterruptGuard::interrupted() {
  return stop_wanted;
}

}  // namespace ashlar

#include "apps/results/system/interrupt_guard.hpp"

#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <mutex>
#include <string_view>

#include "apps/results/system/this_process.hpp"

namespace ashlar {
namespace {

constexpr std::array handled = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1, SIGPIPE, SIGXFSZ};

/// s. `timeout` and others send a signal to a program and to its group: two signals this close are one request.
constexpr double one_request = 0.25;

// Read and written by handlers, and by guards of other threads.
std::atomic<bool> stop_wanted = false;
std::atomic<bool> on_terminal = false;
std::atomic<double> first_request = 0.0;  ///< monotonic time, s
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free);

double monotonic_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Number of guards, and the handlers before the first of them.
struct Guards {
  std::mutex mutex;
  int count = 0;
  std::array<struct sigaction, handled.size()> before{};
};

Guards& guards() {
  static Guards all;
  return all;
}

extern "C" void on_interrupt(int signal) {
  const double now = monotonic_seconds();
  if (!stop_wanted.exchange(true)) {
    first_request = now;
    // A step may take long, and a second Ctrl-C loses unsaved results.
    constexpr std::string_view note = "\nstopping after this step; Ctrl-C once more ends at once, unsaved\n";
    if (on_terminal) write_to_errors(note);
    return;
  }
  if (signal == SIGXCPU || now - first_request < one_request) return;
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

/// True if the caller of a library handles a signal, or ignores it.
static bool left_to_others(int signal, const struct sigaction& old) {
  const bool announces = signal == SIGQUIT || signal == SIGXCPU || signal == SIGUSR1;
  return announces && old.sa_handler != SIG_DFL;
}

InterruptGuard::InterruptGuard() {
  Guards& all = guards();
  const std::lock_guard lock(all.mutex);
  if (all.count++ > 0) return;
  stop_wanted = false;
  on_terminal = errors_go_to_a_terminal();
  for (std::size_t k = 0; k < handled.size(); ++k) {
    const bool stops = handled[k] != SIGPIPE && handled[k] != SIGXFSZ;
    sigaction(handled[k], nullptr, &all.before[k]);
    if (handled[k] == SIGHUP && all.before[k].sa_handler == SIG_IGN) continue;
    if (left_to_others(handled[k], all.before[k])) continue;
    struct sigaction action {};
    action.sa_handler = stops ? on_interrupt : SIG_IGN;
    sigaction(handled[k], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  Guards& all = guards();
  const std::lock_guard lock(all.mutex);
  if (--all.count > 0) return;
  for (std::size_t k = 0; k < handled.size(); ++k) sigaction(handled[k], &all.before[k], nullptr);
}

bool InterruptGuard::interrupted() {
  return stop_wanted;
}

}  // namespace ashlar

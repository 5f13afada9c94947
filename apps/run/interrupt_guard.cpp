#include "apps/run/interrupt_guard.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <mutex>
#include <string_view>

namespace ashlar {
namespace {

constexpr std::array handled = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1, SIGPIPE, SIGXFSZ};

// Handlers read and write these; guards of other threads do, too.
std::atomic<bool> stop_wanted = false;
std::atomic<bool> on_terminal = false;
static_assert(std::atomic<bool>::is_always_lock_free);

/// Guards that live, and the handlers from before the first of them.
struct Guards {
  std::mutex mutex;
  int count = 0;
  std::array<struct sigaction, handled.size()> before{};
};

Guards& guards() {
  static Guards all;
  return all;
}

extern "C" void on_interrupt(int) {
  const bool is_first = !stop_wanted.exchange(true);
  // A step may take long, and a second Ctrl-C loses what was not saved.
  constexpr std::string_view note = "\nstopping after this step; Ctrl-C once more ends at once, unsaved\n";
  if (is_first && on_terminal) (void)!::write(STDERR_FILENO, note.data(), note.size());
}

}  // namespace

/// What the caller of a library wants with these is not known: they are only its own as long as it says nothing.
static bool left_to_others(int signal, const struct sigaction& old) {
  const bool announces = signal == SIGQUIT || signal == SIGXCPU || signal == SIGUSR1;
  return announces && old.sa_handler != SIG_DFL;
}

InterruptGuard::InterruptGuard() {
  Guards& all = guards();
  const std::lock_guard lock(all.mutex);
  if (all.count++ > 0) return;
  stop_wanted = false;
  on_terminal = ::isatty(STDERR_FILENO) != 0;
  for (std::size_t k = 0; k < handled.size(); ++k) {
    const bool stops = handled[k] != SIGPIPE && handled[k] != SIGXFSZ;
    sigaction(handled[k], nullptr, &all.before[k]);
    if (handled[k] == SIGHUP && all.before[k].sa_handler == SIG_IGN) continue;
    if (left_to_others(handled[k], all.before[k])) continue;
    struct sigaction action {};
    action.sa_handler = stops ? on_interrupt : SIG_IGN;
    action.sa_flags = stops && handled[k] != SIGXCPU ? static_cast<int>(SA_RESETHAND) : 0;
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

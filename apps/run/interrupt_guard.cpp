#include "apps/run/interrupt_guard.hpp"

#include <unistd.h>

#include <string_view>

namespace ashlar {
namespace {

volatile std::sig_atomic_t stop_wanted = 0;
volatile std::sig_atomic_t on_terminal = 0;

extern "C" void on_interrupt(int) {
  const bool is_first = stop_wanted == 0;
  stop_wanted = 1;
  // A step may take long, and a second Ctrl-C loses what was not saved.
  constexpr std::string_view note = "\nstopping after this step; Ctrl-C once more ends at once, unsaved\n";
  if (is_first && on_terminal != 0) (void)!::write(STDERR_FILENO, note.data(), note.size());
}

}  // namespace

/// What the caller of a library wants with these is not known: they are only its own as long as it says nothing.
static bool left_to_others(int signal, const struct sigaction& old) {
  const bool announces = signal == SIGQUIT || signal == SIGXCPU || signal == SIGUSR1;
  return announces && old.sa_handler != SIG_DFL;
}

InterruptGuard::InterruptGuard() {
  stop_wanted = 0;
  on_terminal = ::isatty(STDERR_FILENO);
  for (std::size_t k = 0; k < handled.size(); ++k) {
    const bool stops = handled[k] != SIGPIPE && handled[k] != SIGXFSZ;
    sigaction(handled[k], nullptr, &old_[k]);
    if (handled[k] == SIGHUP && old_[k].sa_handler == SIG_IGN) continue;
    if (left_to_others(handled[k], old_[k])) continue;
    struct sigaction action {};
    action.sa_handler = stops ? on_interrupt : SIG_IGN;
    action.sa_flags = stops && handled[k] != SIGXCPU ? static_cast<int>(SA_RESETHAND) : 0;
    sigaction(handled[k], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t k = 0; k < handled.size(); ++k) sigaction(handled[k], &old_[k], nullptr);
}

bool InterruptGuard::interrupted() {
  return stop_wanted != 0;
}

}  // namespace ashlar

// Signals while a run goes on.
#pragma once

#include <array>
#include <csignal>

namespace ashlar {

/// As long as it lives, SIGINT, SIGTERM and SIGHUP (a terminal that closes) are requests to stop after the
/// present step; a second one ends the program at once. SIGHUP stays ignored where it was, as under nohup. So are SIGQUIT,
/// SIGXCPU (a limit of processor time) and SIGUSR1 (what batch systems announce the end of a job by), where they would
/// end the process; the system repeats SIGXCPU each second, which is no second request. A log that nobody reads any more
/// and a limit on the size of files do not end the program: writing fails instead, and what fails is told.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether to stop.
  [[nodiscard]] static bool interrupted();

 private:
  static constexpr std::array handled = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,
                                         SIGXCPU, SIGUSR1, SIGPIPE, SIGXFSZ};
  std::array<struct sigaction, handled.size()> old_{};
};

}  // namespace ashlar

// Handling of signals while the program works.
#pragma once

namespace ashlar {

/// While an object exists, SIGINT, SIGTERM and SIGHUP (a terminal that closes) are requests to stop after the present
/// step. A second one, later than a quarter of a second, ends the program at once. SIGHUP stays ignored if it was, as
/// under nohup. SIGQUIT, SIGXCPU (a limit of processor time) and SIGUSR1 (sent by batch systems before the end of a
/// job) are requests too, if they would end the process. The system repeats SIGXCPU each second, which is no second
/// request. A closed log and a limit on file sizes do not end the program: writing fails instead, and the failure is
/// reported.
///
/// Several may exist at a time, in several threads: the first sets the handlers, and the last to be destroyed
/// restores the earlier ones. A request is for all of them, and is kept until none exists.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// True if a stop was requested.
  [[nodiscard]] static bool interrupted();
};

}  // namespace ashlar

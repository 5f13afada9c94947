// Signals while a run goes on.
#pragma once

namespace ashlar {

/// As long as one lives, SIGINT, SIGTERM and SIGHUP (a terminal that closes) are requests to stop after the present step; a
/// second one, later than a quarter of a second, ends the program at once. SIGHUP stays ignored where it was, as under
/// nohup. SIGQUIT, SIGXCPU (a limit of processor time) and SIGUSR1 (what batch systems announce the end of a job by) are
/// requests, too, where they would end the process; the system repeats SIGXCPU each second, which is no second request. A
/// log that nobody reads any more and a limit on the size of files do not end the program: writing fails instead, and
/// what fails is told.
///
/// Several may live at a time, in several threads: the first sets the handlers, and the last to end, whichever it is,
/// puts back those that were there before. A request is to all of them, and is kept until none is left.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether to stop.
  [[nodiscard]] static bool interrupted();
};

}  // namespace ashlar

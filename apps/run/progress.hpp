// Progress of a simulation on stderr: a live line on a terminal, a few plain lines elsewhere.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace ashlar {

/// One accepted step.
struct ProgressState {
  std::int64_t step = 0;
  double time = 0.0;              ///< s, simulated
  double time_step = 0.0;         ///< s
  int contacts = 0;               ///< point-to-face contacts in any state
  int open_close_iterations = 0;  ///< of this step
};

enum class ProgressMode {
  silent,  ///< nothing
  plain,   ///< a complete line at intervals, and one for the last step
  live,    ///< one line, rewritten in place with terminal control codes
};

/// silent if `quiet`, live if stderr is a terminal that can rewrite a line, otherwise plain.
[[nodiscard]] ProgressMode choose_progress_mode(bool quiet);

/// "step 950  t = 0.95 / 1.35 s  dt = 1e-03 s  contacts 4  open-close 2  left 0:07".
/// @param seconds_left wall time; omitted if unknown.
[[nodiscard]] std::string format_progress(const ProgressState& state, double end_time,
                                          std::optional<double> seconds_left);

class ProgressLine {
 public:
  /// @param end_time s, simulated. @param out stderr or its substitute
  ProgressLine(double end_time, bool quiet, std::ostream& out);
  /// @param wall_clock s from any origin; determines the intervals of output and the time left.
  ProgressLine(double end_time, ProgressMode mode, std::ostream& out, std::function<double()> wall_clock);
  /// Ends the line, so that a following error message starts on a new one.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Cheap to call after every step: output is limited to ten a second (live), one in five seconds (plain). The time
  /// left is extrapolated with the mean speed since the first call.
  void update(const ProgressState& state);
  /// Ends a live line, so that a message starts on a new one. The next state is written below it.
  void pause();
  /// Writes the last state unless it has been written. No output is written afterwards.
  void finish();

 private:
  void write();

  double end_time_;
  ProgressMode mode_;
  std::ostream& out_;
  std::function<double()> wall_clock_;
  std::optional<ProgressState> first_;  ///< null before the first update()
  ProgressState last_;
  double start_;            ///< wall clock at construction, then at the first update()
  double written_at_;       ///< wall clock
  bool unwritten_ = false;  ///< last_ is newer than the output
  bool line_open_ = false;  ///< live: the cursor stands behind the line
};

}  // namespace ashlar

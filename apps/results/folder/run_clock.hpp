// Wall time within the calls of a run, without the time between them; of a continued one with its earlier sessions.
#pragma once

#include <chrono>
#include <optional>

#include "apps/results/folder/run_outcome.hpp"

namespace ashlar {

class RunClock {
 public:
  /// One call of the run, from here to its end.
  class Call {
   public:
    explicit Call(RunClock& clock) : clock_(clock) { clock_.call_start_ = now(); }
    ~Call() {
      clock_.seconds_.total = clock_.session_total();
      clock_.call_start_.reset();
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    RunClock& clock_;
  };

  /// Adds the time since a time of now(), outside calls.
  void add_since(double start) { seconds_.total += now() - start; }
  /// Adds the times of earlier sessions.
  void add_earlier(const RunSeconds& earlier) { earlier_ = earlier; }
  /// Ends the setup.
  void note_setup() { seconds_.setup = session_total(); }
  /// For a Stopwatch.
  [[nodiscard]] double& output() { return seconds_.output; }

  /// s, including the present call so far.
  [[nodiscard]] RunSeconds seconds() const {
    return {earlier_.total + session_total(), earlier_.setup + seconds_.setup,
            earlier_.output + seconds_.output};
  }

  [[nodiscard]] static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  [[nodiscard]] double session_total() const {
    return seconds_.total + (call_start_ ? now() - *call_start_ : 0.0);
  }

  RunSeconds earlier_;
  RunSeconds seconds_;  ///< of this session, without the present call
  std::optional<double> call_start_;
};

}  // namespace ashlar

// Wall time within the calls of a run, without the time between them.
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
      clock_.seconds_ = clock_.seconds();
      clock_.call_start_.reset();
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    RunClock& clock_;
  };

  /// Ends the setup, which began at a time of now().
  void note_setup(double start) { seconds_.total = seconds_.setup = now() - start; }
  /// For a Stopwatch.
  [[nodiscard]] double& output() { return seconds_.output; }

  /// s, including the present call so far.
  [[nodiscard]] RunSeconds seconds() const {
    RunSeconds all = seconds_;
    if (call_start_) all.total += now() - *call_start_;
    return all;
  }

  [[nodiscard]] static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  RunSeconds seconds_;
  std::optional<double> call_start_;
};

}  // namespace ashlar

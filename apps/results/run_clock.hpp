// Wall time inside the calls of a run: what its caller does in between does not count.
#pragma once

#include <chrono>
#include <optional>

#include "apps/results/run_outcome.hpp"

namespace ashlar {

class RunClock {
 public:
  /// From here to its end the time is of the run, of an inner one of its output.
  class Span {
   public:
    enum class Part { run, output };
    explicit Span(RunClock& clock, Part part = Part::run) : clock_(clock), part_(part), start_(now()) {
      if (part_ == Part::run) clock_.running_since_ = start_;
    }
    ~Span() {
      (part_ == Part::run ? clock_.seconds_.total : clock_.seconds_.output) += now() - start_;
      if (part_ == Part::run) clock_.running_since_.reset();
    }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    RunClock& clock_;
    Part part_;
    double start_;
  };

  /// The setup began at a time of now() and is over.
  void note_setup(double start) { seconds_.total = seconds_.setup = now() - start; }

  /// s, with the present call so far.
  [[nodiscard]] RunSeconds seconds() const {
    RunSeconds all = seconds_;
    if (running_since_) all.total += now() - *running_since_;
    return all;
  }

  [[nodiscard]] static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  RunSeconds seconds_;
  std::optional<double> running_since_;
};

}  // namespace ashlar

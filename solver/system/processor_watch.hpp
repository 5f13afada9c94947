// Processor time of parts of a program: other programs on the machine hardly change it.
#pragma once

#include <ctime>

namespace ashlar {

/// Adds the processor time of this thread since its construction to a sum, in seconds, when it goes out of scope.
class ProcessorWatch {
 public:
  explicit ProcessorWatch(double& sum) : sum_(sum), start_(now()) {}
  ~ProcessorWatch() { sum_ += now() - start_; }
  ProcessorWatch(const ProcessorWatch&) = delete;
  ProcessorWatch& operator=(const ProcessorWatch&) = delete;

 private:
  static constexpr double nanosecond = 1e-9;  ///< s
  [[nodiscard]] static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + nanosecond * static_cast<double>(time.tv_nsec);
  }

  double& sum_;
  double start_;
};

}  // namespace ashlar

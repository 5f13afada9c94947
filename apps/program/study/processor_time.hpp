// Processor time for studies, which other programs hardly change.
#pragma once

#include <ctime>

namespace ashlar {

/// Processor time of this process so far, s.
[[nodiscard]] inline double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace ashlar

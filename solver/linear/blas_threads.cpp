#include "solver/linear/blas_threads.hpp"

#include <mutex>

extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));
extern "C" void omp_set_max_active_levels(int levels) __attribute__((weak));

namespace ashlar {

void keep_blas_to_this_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  });
  // The limit of nested teams is one of the calling thread.
  thread_local bool limited = false;
  if (limited) return;
  if (omp_set_max_active_levels != nullptr) omp_set_max_active_levels(0);
  limited = true;
}

}  // namespace ashlar

#include "solver/linear/blas_threads.hpp"

#include <mutex>

#include "solver/system/openblas.hpp"

namespace ashlar {

void keep_blas_to_this_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (const auto set = openblas().set_num_threads; set != nullptr) set(1);
  });
  // The limit of nested teams is one of the calling thread.
  thread_local bool limited = false;
  if (limited) return;
  if (const auto set = openblas().set_max_active_levels; set != nullptr) set(0);
  limited = true;
}

}  // namespace ashlar

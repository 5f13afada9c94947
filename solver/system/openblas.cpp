#include "solver/system/openblas.hpp"

// Null with another implementation.
extern "C" {
void* blas_memory_alloc(int position) __attribute__((weak));
void blas_memory_free(void* buffer) __attribute__((weak));
void openblas_set_num_threads(int threads) __attribute__((weak));
void omp_set_max_active_levels(int levels) __attribute__((weak));
}

namespace ashlar {

OpenBlas openblas() {
  return {blas_memory_alloc, blas_memory_free, openblas_set_num_threads, omp_set_max_active_levels};
}

}  // namespace ashlar

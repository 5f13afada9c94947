#include "solver/system/openblas.hpp"

// A program for Windows has no weak names: it is linked with OpenBLAS, which is built for one thread.
extern "C" {
void* blas_memory_alloc(int position);
void blas_memory_free(void* buffer);
}

namespace ashlar {

OpenBlas openblas() {
  return {blas_memory_alloc, blas_memory_free, nullptr, nullptr};
}

}  // namespace ashlar

// BLAS in the calling thread only: OpenBLAS would use all cores for small fronts, and the order of sums would depend on
// their number. CHOLMOD would start four threads for loops that take less time than that.
#pragma once

#include "solver/linear/blas_memory.hpp"

namespace ashlar {

/// Loops of CHOLMOD and OpenBLAS that the calling thread starts remain in it.
void keep_blas_to_this_thread();

/// The calling thread may call BLAS, which remains in it, during the lifetime of this object.
class OneThreadBlas {
 public:
  /// @throws BlasMemoryError
  OneThreadBlas() { keep_blas_to_this_thread(); }

 private:
  BlasUse use_;
};

}  // namespace ashlar

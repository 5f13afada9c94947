// Working memory of OpenBLAS. It maps 128 MiB of address space for each thread in a call, and retries without end if
// that fails. So the space is requested here first, and a failure is an exception.
#pragma once

#include <new>
#include <shared_mutex>

namespace ashlar {

/// Not enough memory for the working memory of BLAS.
struct BlasMemoryError : std::bad_alloc {
  [[nodiscard]] const char* what() const noexcept override;
};

/// The calling thread may call BLAS during the lifetime of this object. Nothing is mapped before the first one of a
/// thread, and nothing is requested with implementations other than OpenBLAS.
class BlasUse {
 public:
  /// @throws BlasMemoryError
  BlasUse();

 private:
  std::shared_lock<std::shared_mutex> lock_;
};

}  // namespace ashlar

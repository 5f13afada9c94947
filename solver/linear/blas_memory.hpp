// Memory that OpenBLAS works in. It maps 128 MiB of address space for each thread that is inside it, and where that fails
// it tries again without end; so the space is asked for here first, and a failure is an exception.
#pragma once

#include <new>
#include <shared_mutex>

namespace ashlar {

/// There is no room for the working memory of BLAS.
struct BlasMemoryError : std::bad_alloc {
  [[nodiscard]] const char* what() const noexcept override;
};

/// The calling thread may call BLAS while this lives. Nothing is mapped before a thread's first one; of an implementation
/// other than OpenBLAS nothing is asked.
class BlasUse {
 public:
  /// @throws BlasMemoryError
  BlasUse();

 private:
  std::shared_lock<std::shared_mutex> lock_;
};

}  // namespace ashlar

// Functions of OpenBLAS, and of the OpenMP that it may be built with, that other implementations of BLAS do not have.
#pragma once

namespace ashlar {

/// Null where the implementation has none.
struct OpenBlas {
  void* (*memory_alloc)(int position);
  void (*memory_free)(void* buffer);
  void (*set_num_threads)(int threads);
  void (*set_max_active_levels)(int levels);  ///< of OpenMP's nested teams
};

[[nodiscard]] OpenBlas openblas();

}  // namespace ashlar

// OpenBLAS keeps a mapped buffer for the next thread that calls it. So as many buffers must be mapped as threads can
// be in BLAS at a time. Threads are counted. For each new thread one more buffer is mapped while no other thread is
// in BLAS, when exactly the existing buffers are free.
#include "solver/linear/blas_memory.hpp"

#include <cstddef>
#include <mutex>
#include <vector>

#include "solver/system/address_space.hpp"
#include "solver/system/openblas.hpp"

namespace ashlar {
namespace {

/// Bytes of a buffer (OpenBLAS's BUFFER_SIZE is 128 MiB or less) plus a reserve for allocations of other threads.
constexpr std::size_t asked_bytes = (std::size_t{128} + 16) << 20U;

/// Live threads that have called BLAS, and the mapped buffers.
struct Threads {
  std::shared_mutex mutex;  ///< shared by all threads in BLAS
  std::size_t counted = 0;
  std::size_t mapped = 0;
};

// Never destroyed: threads may end after the destruction of static objects.
Threads& threads() {
  static auto& all = *new Threads;
  return all;
}

/// Makes OpenBLAS map one more buffer. @throws BlasMemoryError
void map_one_more(std::size_t mapped) {
  std::vector<void*> buffers;
  buffers.reserve(mapped + 1);
  if (!has_room_for(asked_bytes)) throw BlasMemoryError();
  const OpenBlas blas = openblas();
  while (buffers.size() <= mapped) buffers.push_back(blas.memory_alloc(0));
  for (void* buffer : buffers) blas.memory_free(buffer);
}

/// One for each thread that calls BLAS.
class CountedThread {
 public:
  ~CountedThread() {
    if (!counted_) return;
    const std::unique_lock lock(threads().mutex);
    --threads().counted;
  }
  void count() {
    if (counted_ || openblas().memory_alloc == nullptr || openblas().memory_free == nullptr) return;
    Threads& all = threads();
    const std::unique_lock lock(all.mutex);
    if (all.counted == all.mapped) {
      map_one_more(all.mapped);
      ++all.mapped;
    }
    ++all.counted;
    counted_ = true;
  }

 private:
  bool counted_ = false;
};

}  // namespace

const char* BlasMemoryError::what() const noexcept {
  return "out of memory: 128 MiB of address space are needed for each thread that factorises";
}

BlasUse::BlasUse() {
  thread_local CountedThread thread;
  thread.count();
  lock_ = std::shared_lock(threads().mutex);
}

}  // namespace ashlar

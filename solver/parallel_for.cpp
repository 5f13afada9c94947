// oneTBB does the work. The thread sanitizer sees only half of it, as the library of the system is not
// compiled with that: it then either takes TBB's own hand-overs for races or, with those suppressed, sees no
// race at all. So the build with the thread sanitizer uses plain threads, and races between pieces of work
// are found.
#include "solver/parallel_for.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

// gcc says so by a macro, clang by a feature. The macro first: libraries define __has_feature, as none, for gcc.
#if defined(__SANITIZE_THREAD__)
#define ASHLAR_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define ASHLAR_THREAD_SANITIZER
#endif
#endif

namespace ashlar {

namespace {

/// Pieces of work on several threads. The first exception waits here for the caller: TBB would allocate to carry it, and
/// ends the program where it cannot.
class Pieces {
 public:
  explicit Pieces(const std::function<void(std::size_t)>& work) : work_(work) {}

  /// One piece, unless one has failed.
  void operator()(std::size_t k) {
    // Relaxed: a stronger order would put the pieces of a thread before those that another does later, and only
    // races between pieces that overlap in time would be seen.
    if (failed_.load(std::memory_order_relaxed)) return;
    try {
      work_(k);
    } catch (...) {
      failed_.store(true, std::memory_order_relaxed);
      const std::scoped_lock lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }

  /// @throws what the first piece that failed threw
  void check() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const std::function<void(std::size_t)>& work_;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr error_;
};

}  // namespace

#if defined(ASHLAR_THREAD_SANITIZER)

void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  Pieces pieces(work);
  const auto take = [&] { return next.fetch_add(1, std::memory_order_relaxed); };
  const auto work_on = [&] {
    for (std::size_t k = take(); k < count; k = take()) pieces(k);
  };
  {
    std::vector<std::jthread> team;
    const auto helpers = std::min(static_cast<std::size_t>(threads), count);
    for (std::size_t k = 1; k < helpers; ++k) team.emplace_back(work_on);
    work_on();
  }
  pieces.check();
}

#else

namespace {

/// An arena costs more to make than a short loop takes: they are made once for each number of threads.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static std::map<int, tbb::task_arena> arenas;
  const std::scoped_lock lock(mutex);
  return arenas.try_emplace(threads, threads).first->second;
}

}  // namespace

void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  if (threads == 1 || count < 2) {
    for (std::size_t k = 0; k < count; ++k) work(k);
    return;
  }
  Pieces pieces(work);
  // More than the machine has would make TBB print a warning and go on with fewer.
  arena_of(std::min(threads, available_threads())).execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) { pieces(k); });
  });
  pieces.check();
}

#endif

int available_threads() {
  return std::max(1, tbb::info::default_concurrency());
}

}  // namespace ashlar

// oneTBB runs the tasks. The system's library is not compiled with the thread sanitizer, which then either reports
// TBB's own synchronisation as races or, if these reports are suppressed, misses all races. So builds with the thread
// sanitizer use plain threads, and races between tasks are detected.
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

// gcc indicates it by a macro, clang by a feature. The macro is tested first: libraries define an empty __has_feature
// for gcc.
#if defined(__SANITIZE_THREAD__)
#define ASHLAR_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define ASHLAR_THREAD_SANITIZER
#endif
#endif

namespace ashlar {

namespace {

/// Tasks on several threads. Stores the first exception for the caller: TBB would allocate memory for it, and
/// terminates the program if that fails.
class Pieces {
 public:
  explicit Pieces(const std::function<void(std::size_t)>& work) : work_(work) {}

  /// Runs one task, unless one has failed.
  void operator()(std::size_t k) {
    // Relaxed: a stronger order would order the tasks of a thread before later tasks of others, and hide races
    // between tasks that do not overlap in time.
    if (failed_.load(std::memory_order_relaxed)) return;
    try {
      work_(k);
    } catch (...) {
      failed_.store(true, std::memory_order_relaxed);
      const std::scoped_lock lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }

  /// @throws the exception of the first task that failed
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

/// An arena takes longer to construct than a short loop: one is kept for each number of threads.
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
  // More threads than the machine has would make TBB print a warning and use fewer.
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

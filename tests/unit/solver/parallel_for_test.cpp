#include "solver/parallel_for.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ashlar::parallel_for_test {
namespace {

TEST(ParallelFor, DoesEachPieceOnce) {
  for (const int threads : {1, 2, 8}) {
    for (const std::size_t count : {0U, 1U, 7U, 5000U}) {
      std::vector<int> calls(count, 0);
      parallel_for(threads, count, [&](std::size_t k) { ++calls[k]; });
      EXPECT_EQ(calls, std::vector<int>(count, 1)) << threads << " threads";
    }
  }
}

TEST(ParallelFor, OneThreadIsTheCallersOwn) {
  std::vector<std::thread::id> ids(100);
  parallel_for(1, ids.size(), [&](std::size_t k) { ids[k] = std::this_thread::get_id(); });
  EXPECT_EQ(ids, std::vector<std::thread::id>(100, std::this_thread::get_id()));
}

// Two pieces that wait for each other end only if two threads work on them.
TEST(ParallelFor, UsesAsManyThreadsAsAllowed) {
  if (available_threads() < 2) GTEST_SKIP() << "one core";
  std::atomic<int> arrived = 0;
  parallel_for(2, 2, [&](std::size_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(ParallelFor, ThrowsOnWhatAPieceThrows) {
  for (const int threads : {1, 4}) {
    EXPECT_THROW(parallel_for(threads, 1000,
                              [](std::size_t k) {
                                if (k == 500) throw std::out_of_range("500");
                              }),
                 std::out_of_range);
  }
}

// As where memory ends: nearly all pieces throw, on all threads.
TEST(ParallelFor, ThrowsOnceWhereManyPiecesDo) {
  for (const int threads : {1, 2, 8}) {
    EXPECT_THROW(parallel_for(threads, 5000,
                              [](std::size_t k) {
                                if (k % 10 != 0) throw std::bad_alloc();
                              }),
                 std::bad_alloc);
  }
}

}  // namespace
}  // namespace ashlar::parallel_for_test

// The only use of several threads in this program: independent tasks that each write only their own result.
#pragma once

#include <cstddef>
#include <functional>

namespace ashlar {

/// Calls work(0), ..., work(count - 1), each once, in any order, on up to `threads` threads. Returns when all are
/// done. Rethrows the first exception of a task; tasks that have not started may then be skipped.
/// @param threads >= 1
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& work);

/// Number of hardware threads, at least 1.
[[nodiscard]] int available_threads();

}  // namespace ashlar

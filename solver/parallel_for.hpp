// The one way this program uses several threads: independent pieces of work, each writing only its own
// result.
#pragma once

#include <cstddef>
#include <functional>

namespace ashlar {

/// Calls work(0), ..., work(count - 1), each once, in any order, on up to `threads` threads; returns when all
/// are done. The first exception of a piece is thrown on; pieces not yet begun may then be left out.
/// @param threads >= 1
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& work);

/// How many threads this machine runs at once, at least 1.
[[nodiscard]] int available_threads();

}  // namespace ashlar

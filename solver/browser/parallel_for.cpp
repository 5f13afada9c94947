// A page has one thread: tasks run one after the other, and oneTBB is not needed.
#include "solver/parallel_for.hpp"

namespace ashlar {

void parallel_for(int /*threads*/, std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t k = 0; k < count; ++k) work(k);
}

int available_threads() {
  return 1;
}

}  // namespace ashlar

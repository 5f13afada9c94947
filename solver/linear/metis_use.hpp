// METIS draws random numbers from rand(), whose state all threads share. Its orders depend on the graph only if one thread
// at a time calls it.
#pragma once

#include <mutex>

namespace ashlar {

/// The calling thread may call METIS during the lifetime of this object.
class MetisUse {
 public:
  MetisUse() : lock_(mutex()) {}

 private:
  [[nodiscard]] static std::mutex& mutex() {
    static std::mutex all;
    return all;
  }
  std::scoped_lock<std::mutex> lock_;
};

}  // namespace ashlar

// One target for libFuzzer, which brings the main function; ASHLAR_FUZZ_TARGET is its name.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)ashlar::fuzz::ASHLAR_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  } catch (const ashlar::fuzz::BrokenPromise& broken) {
    std::fprintf(stderr, "broken promise: %s\n", broken.what);
    std::abort();
  }
  return 0;
}

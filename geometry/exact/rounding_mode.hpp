// The floating-point environment the filters are proved for.
#pragma once

#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace ashlar {

/// While alive, the thread rounds to nearest, traps nothing and keeps subnormal numbers, whatever the caller
/// has set; the destructor restores that. Code under its protection must be in a function of its own that is
/// not inlined into the one that holds the guard: compilers move arithmetic across changes of the mode.
class NearestRounding {
 public:
#if defined(__SSE2__)
  NearestRounding() : saved_(_mm_getcsr()) {
    if ((saved_ & control_bits) != default_control) _mm_setcsr(default_control);
  }
  ~NearestRounding() {
    if ((saved_ & control_bits) != default_control) _mm_setcsr(saved_);
  }
#else
  NearestRounding() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~NearestRounding() {
    std::fesetenv(&saved_);
  }
#endif
  NearestRounding(const NearestRounding&) = delete;
  NearestRounding& operator=(const NearestRounding&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned default_control = 0x1f80U;  // all exceptions masked, to nearest, no flushing
  static constexpr unsigned control_bits = 0xffc0U;
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

}  // namespace ashlar

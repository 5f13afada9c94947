// A page sends no signals: it ends the worker that runs the program, at once and without a last state.
#include "apps/results/system/interrupt_guard.hpp"

namespace ashlar {

InterruptGuard::InterruptGuard() = default;

InterruptGuard::~InterruptGuard() = default;

bool InterruptGuard::interrupted() {
  return false;
}

}  // namespace ashlar

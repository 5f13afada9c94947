// A run that ends when a signal asks for it.
#pragma once

#include "apps/results/system/interrupt_guard.hpp"
#include "apps/run/run_observer.hpp"

namespace ashlar {

/// Ends a run once a stop was requested. @pre an InterruptGuard exists during the run
class InterruptObserver : public RunObserver {
 public:
  [[nodiscard]] bool may_continue() override { return !InterruptGuard::interrupted(); }
};

}  // namespace ashlar

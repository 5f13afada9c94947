// The history of a support as mechanics takes it.
#pragma once

#include "apps/scene.hpp"
#include "mechanics/support_motion.hpp"

namespace ashlar {

inline SupportHistory support_history(const SceneFix& fix) {
  SupportHistory history;
  for (const SceneFix::Motion& motion : fix.displacement_history) {
    history.times.push_back(motion.time);
    history.displacements.push_back(motion.displacement);
  }
  return history;
}

}  // namespace ashlar

// Converts the history of a support for mechanics.
#pragma once

#include "apps/scene/model/scene.hpp"
#include "mechanics/supports/support_motion.hpp"

namespace ashlar {

inline SupportHistory support_history(const SceneFix& fix) {
  SupportHistory history;
  history.record = fix.record;
  for (const SceneFix::Motion& motion : fix.history) {
    history.times.push_back(motion.time);
    history.values.push_back(motion.value);
  }
  return history;
}

}  // namespace ashlar

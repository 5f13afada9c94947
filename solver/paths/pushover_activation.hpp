// The multiplier at which pushed blocks begin to move, as a slow test shows it: on the load path (path_search.hpp), where
// joints are elastic and friction does not dilate. The curve of pushover.hpp begins at the largest multiplier that any
// forces balance, which is too large where joints wedge: walls that rock in their plane.
#pragma once

#include "solver/paths/pushover.hpp"

namespace ashlar {

struct PushoverActivation {
  /// Largest multiplier at rest, to `tolerance`; that of the limit if the path reaches it within twice that.
  double multiplier = 0.0;
  bool at_limit = false;  ///< it is that of the limit
};

/// Relative accuracy of the multiplier on the path.
inline constexpr double activation_tolerance = 5e-3;

/// @param limit multiplier of the first place, > 0. @param search its may_continue ends it. @return empty: it was ended
[[nodiscard]] std::optional<PushoverActivation> pushover_activation(const PlacedScene& scene,
                                                                    const PushoverSearch& search,
                                                                    double limit);

}  // namespace ashlar

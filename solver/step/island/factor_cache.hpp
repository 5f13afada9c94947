// Factors that are kept from step to step: of islands and of single blocks.
#pragma once

#include <vector>

#include "solver/step/island/island.hpp"
#include "solver/step/island/lone_body.hpp"

namespace ashlar {

/// Of the factor that BlockShare::step_solver() holds, for later steps. The same on all processes, but for the bodies.
struct SharedFactor {
  std::vector<int> bodies;  ///< own ones of the joined island
  std::vector<int> sizes;   ///< equations of each
  double inertia = 0.0;     ///< TimeScheme::inertia; 0: not usable in another step
};

struct FactorCache {
  explicit FactorCache(LinearMethod method) : islands(method) {}

  IslandSolvers islands;
  LoneBodyFactors lone;
  SharedFactor shared;

  /// Drops factors that have not been used since the last call.
  void drop_unused() {
    islands.drop_unused();
    lone.drop_unused();
  }
  [[nodiscard]] FactorCounts counts() const {
    FactorCounts sum = islands.counts();
    sum += lone.counts();
    return sum;
  }
};

}  // namespace ashlar

// Factors that are kept from step to step: of islands and of single blocks.
#pragma once

#include "solver/step/island.hpp"
#include "solver/step/lone_body.hpp"

namespace ashlar {

struct FactorCache {
  explicit FactorCache(LinearMethod method) : islands(method) {}

  IslandSolvers islands;
  LoneBodyFactors lone;

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

// The linear system of the island whose bodies several processes have.
#pragma once

#include "solver/step/island/island.hpp"
#include "solver/step/island/island_sums.hpp"

namespace ashlar {

class JoinedSystem {
 public:
  virtual ~JoinedSystem() = default;
  [[nodiscard]] virtual const IslandSums& sums() const = 0;
  [[nodiscard]] virtual IslandSolvers::Entry& solver() = 0;
};

}  // namespace ashlar

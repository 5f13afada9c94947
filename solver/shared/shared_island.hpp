// The island of all bodies that touch bodies of other ranks: one system, whose rows the ranks share out.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "solver/linear/linear_solver.hpp"
#include "solver/state/block_system.hpp"
#include "solver/step/island/factor_cache.hpp"
#include "solver/step/island/island.hpp"
#include "solver/step/island/joined_system.hpp"

namespace ashlar {

/// Joins the islands that contain ghosts to one, the last, and removes those of ghosts alone.
/// @param islands find_islands() of own blocks and ghosts
/// @return index of the joined island, which has no bodies on ranks without any; -1: no rank has such islands.
/// Collective
[[nodiscard]] int join_shared_islands(const BlockSystem& system, std::vector<Island>& islands);

/// Lowest block of the set of touching or bolted bodies that each body of the joined island belongs to, by body. Collective.
[[nodiscard]] std::map<int, int> first_blocks(const BlockSystem& system, const Island& island,
                                              const std::vector<ContactPair>& pairs);

/// The linear system of the joined island.
class SharedIslandSystem final : public JoinedSystem {
 public:
  /// All but the scheme and the settings of IslandProblem. The arguments must outlive this. Collective.
  /// @param kept null: solved by BlockShare::solver(). Otherwise by step_solver(), with the factor that it holds of the
  /// same bodies, whatever their pairs; the next one finds there the factor that this leaves
  SharedIslandSystem(const BlockSystem& system, const Island& island, const std::vector<BodyStep>& bodies,
                     const std::vector<ContactPair>& pairs, SharedFactor* kept = nullptr);
  ~SharedIslandSystem() override;
  SharedIslandSystem(const SharedIslandSystem&) = delete;
  SharedIslandSystem& operator=(const SharedIslandSystem&) = delete;

  [[nodiscard]] const IslandSums& sums() const override { return *sums_; }
  [[nodiscard]] IslandSolvers::Entry& solver() override { return *solver_; }

 private:
  std::unique_ptr<const IslandSums> sums_;
  std::unique_ptr<IslandSolvers::Entry> solver_;
  SharedFactor* kept_;
};

}  // namespace ashlar

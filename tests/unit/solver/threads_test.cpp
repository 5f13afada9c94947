// Runs on several threads against one.
#include <gtest/gtest.h>

#include "solver/linear/tree_factor.hpp"
#include "support/simulations.hpp"

namespace ashlar::threads_test {
namespace {

using test_support::block_of;
using test_support::same_law;

/// A wall in running bond, of so many blocks that its matrix has a factor by subtrees (tree_factor.hpp), one block of it lifted.
Simulation wall(int threads) {
  constexpr int rows = 25, columns = 25;
  static_assert(rows * columns > blocks_of_tree_factor);
  std::vector<BlockModel> blocks;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const bool top = row + 1 == rows && column == columns / 2;
      const double x = column + 0.5 * (row % 2), z = 0.5 * row + (top ? 2e-3 : 0.0);
      blocks.emplace_back(block_of("brick", Polyhedron(make_box({x, 0, z}, {x + 1, 0.5, z + 0.5})),
                                   {2000, 1e10, 0.2}, row % 5 == 0 ? 0 : 1));
    }
  }
  blocks.emplace_back(test_support::fixed_box({-2, -1, -1}, {columns + 2, 2, 0}));
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.threads = threads;
  std::vector<InitialMotion> motions(blocks.size());
  return {std::move(blocks), std::move(motions), same_law({1e10, 5e9, 0.6, 0.0, 0.0, true}), settings};
}

Simulation after_steps(int threads) {
  Simulation simulation = wall(threads);
  EXPECT_TRUE(test_support::run_until(simulation, 3e-3));
  return simulation;
}

TEST(Threads, ALargeWallIsTheSameToTheBit) {
  const Simulation one = after_steps(1);
  for (const int threads : {2, 3}) {
    const Simulation several = after_steps(threads);
    for (std::size_t k = 0; k < one.states().size(); ++k) {
      EXPECT_EQ(one.states()[k].position, several.states()[k].position) << k << " on " << threads;
      EXPECT_EQ(one.states()[k].velocity, several.states()[k].velocity) << k << " on " << threads;
    }
    EXPECT_EQ(one.ledger().residual, several.ledger().residual);
  }
}

}  // namespace
}  // namespace ashlar::threads_test

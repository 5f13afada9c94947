// Runs on several threads against one.
#include <gtest/gtest.h>

#include <random>

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

void expect_same(const Simulation& one, const Simulation& several, int threads) {
  for (std::size_t k = 0; k < one.states().size(); ++k) {
    EXPECT_EQ(one.states()[k].position, several.states()[k].position) << k << " on " << threads;
    EXPECT_EQ(one.states()[k].velocity, several.states()[k].velocity) << k << " on " << threads;
  }
  EXPECT_EQ(one.ledger().residual, several.ledger().residual) << threads;
  EXPECT_EQ(one.largest_penetration(), several.largest_penetration()) << threads;
}

TEST(Threads, ALargeWallIsTheSameToTheBit) {
  const Simulation one = after_steps(1);
  for (const int threads : {2, 3}) expect_same(one, after_steps(threads), threads);
}

/// Laws that take turns in random heaps.
JointLaw law_of(unsigned seed) {
  JointLaw law{1e9, 5e8, 0.5, 0.0, 0.0, true};
  switch (seed % 6U) {
    case 1:
      law.largest_closure = 2e-4;
      break;
    case 2:
      law.roughness = {10.0, 3e7, law.friction};
      break;
    case 3:
      law.compressive_strength = 2e6;
      break;
    case 4:
      law.dilation = 0.1;
      break;
    case 5:
      law.damping = 0.3;
      break;
    default:
      break;
  }
  return law;
}

/// A heap of turned boxes of random size, order and velocity on a base.
Simulation heap(unsigned seed, int threads) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  const auto direction = [&] { return Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); };
  std::vector<BlockModel> blocks;
  std::vector<InitialMotion> motions;
  for (int layer = 0; layer < 3; ++layer) {
    for (int k = 0; k < 6; ++k) {
      const Vector3 middle(0.55 * (k % 3), 0.55 * (k / 3), 0.3 + 0.5 * layer);
      const Vector3 half(uniform(0.15, 0.25), uniform(0.15, 0.25), uniform(0.1, 0.2));
      const Eigen::AngleAxisd turn(uniform(0.0, 0.3), (direction() + Vector3(0, 0, 2)).normalized());
      blocks.emplace_back(block_of(
          "stone", test_support::turned(Polyhedron(make_box(middle - half, middle + half)), turn, middle),
          {2500, 1e9, 0.2}, static_cast<int>(random() % 3U)));
      motions.emplace_back().velocity = 0.5 * direction() - Vector3(0, 0, 2.0);
    }
  }
  blocks.emplace_back(test_support::fixed_box({-2, -2, -1}, {3, 3, 0}));
  motions.emplace_back();
  SimulationSettings settings;
  settings.time_step = 2e-3;
  settings.threads = threads;
  settings.augmented = seed % 12U == 6U;
  return {std::move(blocks), std::move(motions), same_law(law_of(seed)), settings};
}

TEST(Threads, RandomHeapsAreTheSameToTheBit) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    Simulation one = heap(seed, 1);
    ASSERT_TRUE(test_support::run_until(one, 0.12)) << seed;
    EXPECT_GT(one.report().locked + one.report().sliding, 10) << seed;
    for (const int threads : {2, 5}) {
      Simulation several = heap(seed, threads);
      ASSERT_TRUE(test_support::run_until(several, 0.12)) << seed;
      expect_same(one, several, threads);
    }
  }
}

}  // namespace
}  // namespace ashlar::threads_test

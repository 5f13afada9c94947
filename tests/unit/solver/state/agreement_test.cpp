#include "solver/state/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/shared_runs.hpp"

namespace ashlar::agreement_test {
namespace {

using test_support::Scene;
using test_support::wall;

BlockSystem system_of(const Scene& scene) {
  std::vector<BlockModel> blocks(scene.blocks.begin(), scene.blocks.end());
  return {std::move(blocks), [&scene](int, int) { return scene.law; }, scene.settings, {}};
}

TEST(Agreement, OneProcessAgreesWithItself) {
  const Scene scene = wall(2, 2);
  const BlockSystem system = system_of(scene);
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(system.exchange().alone());
  EXPECT_EQ(sum_of_run(system, 0.1), 0.1);
  EXPECT_TRUE(std::isnan(most_of_run(system, no_number)));
  EXPECT_EQ(least_of_run(system, -3.0), -3.0);
  EXPECT_TRUE(any_of_run(system, true));
  EXPECT_FALSE(all_of_run(system, false));
  EXPECT_EQ(any_of_run(system, std::vector<bool>{true, false}), (std::vector<bool>{true, false}));
  EXPECT_EQ(values_of_run(system, 7), std::vector<int>{7});
  EXPECT_EQ(first_of_run(system, std::optional<int>{}), std::nullopt);
  EXPECT_EQ(joined_of_run(system, std::vector<int>{1, 2}), (std::vector<int>{1, 2}));
}

// Rank k gives k + 1, or nothing where it says so.
TEST(Agreement, ProcessesGetTheSame) {
  const Scene scene = wall(4, 2);
  for (const int count : {2, 3}) {
    run_on_threads(count, [&](Ranks& ranks) {
      std::vector<int> owners(scene.blocks.size(), 0);
      for (std::size_t k = 0; k < owners.size(); ++k) owners[k] = static_cast<int>(k) % count;
      const BlocksOfRank own = share_blocks(
          ranks, owners, [&](int block) { return BlockModel(scene.blocks[static_cast<std::size_t>(block)]); },
          scene.settings);
      const BlockSystem system(
          own.blocks, [&](int, int) { return scene.law; }, scene.settings, {}, {}, *own.shared->exchange);
      const int mine = ranks.own() + 1;
      const std::optional<int> some = ranks.own() > 0 ? std::optional(mine) : std::nullopt;
      std::vector<int> all;
      for (int k = 1; k <= count; ++k) all.push_back(k);
      EXPECT_FALSE(system.exchange().alone());
      EXPECT_EQ(system.exchange().first(), ranks.own() == 0);
      EXPECT_EQ(sum_of_run(system, static_cast<double>(mine)), count * (count + 1) / 2.0);
      EXPECT_EQ(most_of_run(system, static_cast<double>(mine)), count);
      EXPECT_EQ(least_of_run(system, static_cast<double>(mine)), 1.0);
      EXPECT_TRUE(any_of_run(system, mine == 1));
      EXPECT_FALSE(all_of_run(system, mine == 1));
      EXPECT_EQ(values_of_run(system, mine), all);
      EXPECT_EQ(first_of_run(system, some), std::optional(2));
      EXPECT_EQ(joined_of_run(system, std::vector<int>{mine}), all);
      EXPECT_EQ(most_of_run(system, std::numeric_limits<double>::quiet_NaN()),
                std::numeric_limits<double>::infinity());
    });
  }
}

}  // namespace
}  // namespace ashlar::agreement_test

#include "solver/ranks/partition.hpp"

#include <gmock/gmock.h>

namespace ashlar::partition_test {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(Bisected, CutsAcrossTheLongestSide) {
  // Four along x, two along z: first cut between x = 1 and x = 2, then each half, 2 by 2 wide, across x again.
  std::vector<Eigen::Vector3d> places;
  for (int x = 0; x < 4; ++x)
    for (int z = 0; z < 2; ++z) places.emplace_back(x, 0.0, 0.9 * z);
  const std::vector<double> weights(8, 1.0);
  EXPECT_THAT(bisected(places, weights, 1), Each(0));
  EXPECT_THAT(bisected(places, weights, 2), ElementsAre(0, 0, 0, 0, 1, 1, 1, 1));
  EXPECT_THAT(bisected(places, weights, 4), ElementsAre(0, 0, 1, 1, 2, 2, 3, 3));
}

TEST(Bisected, CutsByWeight) {
  const std::vector<Eigen::Vector3d> places = {{3, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  // Along x: 5, 1, 1, 3; half of 10 are the first.
  EXPECT_THAT(bisected(places, {3.0, 1.0, 1.0, 5.0}, 2), ElementsAre(1, 1, 1, 0));
  // Thirds: 10/3 is nearer to 5 than to 0; of the other two, 5/2 is nearer to 2 than to 5.
  EXPECT_THAT(bisected(places, {3.0, 1.0, 1.0, 5.0}, 3), ElementsAre(2, 1, 1, 0));
}

TEST(Bisected, PartsMayBeEmpty) {
  EXPECT_THAT(bisected({}, {}, 3), testing::IsEmpty());
  // Points of one place are in the order of their index.
  const std::vector<Eigen::Vector3d> places(3, Eigen::Vector3d::Ones());
  EXPECT_THAT(bisected(places, {1.0, 1.0, 2.0}, 2), ElementsAre(0, 0, 1));
  const std::vector<int> parts = bisected(places, {1.0, 1.0, 1.0}, 8);
  EXPECT_NE(parts[0], parts[1]);
  EXPECT_NE(parts[1], parts[2]);
}

TEST(WithNamesOf, KeepsMostOfTheWeight) {
  // Part 0 has 3 in common with rank 1, part 1 has 2 with rank 1 and 1 with rank 0.
  EXPECT_THAT(with_names_of({1, 1, 1, 1, 0}, {0, 0, 1, 1, 1}, {2.0, 1.0, 1.0, 1.0, 1.0}, 2),
              ElementsAre(1, 1, 0, 0, 0));
  // A part that nobody has gets the name left over; blocks that are nowhere stay so.
  EXPECT_THAT(with_names_of({2, 2, -1, -1}, {0, 1, 2, -1}, {2.0, 1.0, 1.0, 1.0}, 3),
              ElementsAre(2, 0, 1, -1));
}

TEST(Imbalance, IsTheLargestWeightRelativeToTheMean) {
  EXPECT_DOUBLE_EQ(imbalance_of({0, 0, 1, -1}, {1.0, 2.0, 1.0, 9.0}, 2), 0.5);
  EXPECT_DOUBLE_EQ(imbalance_of({0, 0, 0, 0}, {1.0, 1.0, 1.0, 1.0}, 4), 3.0);
  EXPECT_DOUBLE_EQ(imbalance_of({}, {}, 4), 0.0);
}

TEST(PartitionByPlace, OneRankGetsAllBlocksThatItKnows) {
  SingleRank ranks;
  PartitionBlock first, second;
  first.block = 4;
  second.block = 1;
  EXPECT_THAT(partition_by_place(ranks, {first, second}, 5), ElementsAre(-1, 0, -1, -1, 0));
}

TEST(Weight, CountsUnknownsAndHalfOfTheContactPoints) {
  EXPECT_EQ(weight_of_block(12, 10), 17.0);
}

}  // namespace
}  // namespace ashlar::partition_test

#include "geometry/boxes/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace ashlar::box_tree_test {
namespace {

// Whole numbers below 2^10: squared distances are exact.
std::vector<Box> random_boxes(std::size_t count, std::mt19937_64& random) {
  const auto whole = [&](unsigned below) { return static_cast<double>(random() % below); };
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    box.include({whole(1000), whole(1000), whole(1000)});
    box.include(box.low + Eigen::Vector3d(whole(20), whole(20), whole(20)));
  }
  return boxes;
}

double squared_distance_to(const Box& box, const Eigen::Vector3d& x) {
  return (x - x.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
}

TEST(BoxTree, FindsTheBoxesThatMeetAGivenOne) {
  std::mt19937_64 random(4);
  for (std::size_t count = 0; count < 300; count += 13) {
    const std::vector<Box> boxes = random_boxes(count, random);
    const BoxTree tree(boxes);
    for (const double size : {0.0, 100.0, 400.0, 2000.0}) {
      const Box around{Eigen::Vector3d::Constant(500.0 - size), Eigen::Vector3d::Constant(500.0 + size)};
      std::vector<int> expected;
      for (std::size_t i = 0; i < count; ++i)
        if (boxes[i].meets(around)) expected.push_back(static_cast<int>(i));
      EXPECT_EQ(tree.meeting(around), expected) << count << " boxes, " << size;
    }
    EXPECT_TRUE(tree.meeting(Box{}).empty());
  }
}

TEST(PackedBoxTree, VisitsEveryBoxWithinTheBoundOnce) {
  std::mt19937_64 random(5);
  for (std::size_t count = 0; count < 70; ++count) {
    const std::vector<Box> boxes = random_boxes(count, random);
    const BoxTree tree(boxes, 1);
    const PackedBoxTree packed(tree);
    for (const double bound : {0.0, 250.0 * 250.0, 1e9}) {
      const Eigen::Vector3d x = count % 2 == 0 || count == 0 ? Eigen::Vector3d(500.0, 400.0, 600.0)
                                                             : Eigen::Vector3d(boxes[count / 2].low);
      std::vector<int> visited, expected;
      packed.for_each_near(
          x, [&] { return bound; },
          [&](int k) { visited.push_back(tree.items()[static_cast<std::size_t>(k)]); });
      for (std::size_t i = 0; i < count; ++i)
        if (squared_distance_to(boxes[i], x) <= bound) expected.push_back(static_cast<int>(i));
      std::sort(visited.begin(), visited.end());
      EXPECT_EQ(visited, expected) << count << " boxes within " << bound;
    }
  }
}

TEST(PackedBoxTree, FindsTheNearestBoxWithABoundThatShrinks) {
  std::mt19937_64 random(6);
  const std::vector<Box> boxes = random_boxes(500, random);
  const BoxTree tree(boxes, 1);
  const PackedBoxTree packed(tree);
  std::size_t visits = 0;
  constexpr int queries = 100;
  for (int q = 0; q < queries; ++q) {
    const Eigen::Vector3d x = 1.5 * random_boxes(1, random)[0].low;
    double best = std::numeric_limits<double>::infinity(), nearest = best;
    packed.for_each_near(
        x, [&] { return best; },
        [&](int k) {
          best = std::min(best, squared_distance_to(tree.box(tree.items()[static_cast<std::size_t>(k)]), x));
          ++visits;
        });
    for (const Box& box : boxes) nearest = std::min(nearest, squared_distance_to(box, x));
    EXPECT_EQ(best, nearest);
  }
  EXPECT_LT(visits, boxes.size() * queries / 10);
}

TEST(PackedBoxTree, RefusesLeavesOfSeveralBoxes) {
  std::mt19937_64 random(7);
  EXPECT_THROW(PackedBoxTree(BoxTree(random_boxes(5, random), 4)), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::box_tree_test

#include "solver/paths/path_search.hpp"

#include <gtest/gtest.h>

#include "unit/solver/statics/sample_limits.hpp"

namespace ashlar::path_search_test {
namespace {

using namespace test_support;

struct BoxOfWall {
  Vector3 low, high;
};

/// Courses of bricks of 0.4 x 0.2 x 0.2 m in running bond, the first course from a whole brick.
std::vector<BoxOfWall> running_bond(double length, int courses) {
  std::vector<BoxOfWall> boxes;
  for (int course = 0; course < courses; ++course) {
    std::vector<double> edges = {0.0};
    for (double edge = course % 2 == 0 ? 0.4 : 0.2; edge < length - 1e-9; edge += 0.4) edges.push_back(edge);
    edges.push_back(length);
    for (std::size_t k = 0; k + 1 < edges.size(); ++k)
      boxes.push_back({{edges[k], 0.0, 0.2 * course}, {edges[k + 1], 0.2, 0.2 * (course + 1)}});
  }
  return boxes;
}

/// Each block with a load of its weight along x, times `side`.
LimitScene pushed_wall(const std::vector<BoxOfWall>& boxes, double friction) {
  LimitScene scene;
  scene.law = joint(friction);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    scene.add(std::to_string(k), Polyhedron(make_box(boxes[k].low, boxes[k].high)));
    const Vector3 size = boxes[k].high - boxes[k].low;
    Load load;
    load.traction = false;
    load.where = Vector3(0.5 * (boxes[k].low + boxes[k].high));
    load.vector = Vector3(rock.density * size.prod() * g, 0.0, 0.0);
    scene.blocks.back().loads.push_back(load);
  }
  scene.add_fixed(Polyhedron(make_box({-1, -1, -0.5}, {3, 1, 0})));
  return scene;
}

struct Found {
  LimitBracket associated;
  PathAnswer path;
};

/// Capacity of the loads, as a share of the weight.
Found capacity_of(const LimitScene& scene, double tolerance = 5e-3) {
  const Simulation simulation = scene.build();
  const std::vector<bool> all(scene.blocks.size(), true);
  const LimitSearch search{0.01, 10.0, tolerance};
  const auto may_continue = [] { return true; };
  Found found;
  found.associated = LimitAnalysis(
                         simulation.rigid_model(1.0, all), [](int, int) { return true; }, 1)
                         .load_factor(search, may_continue)
                         .associated;
  RigidModel model = simulation.spring_model(1.0, all);
  std::vector<double> allowed(model.bodies.size(), 2.5e-3);
  LoadPath path(
      std::move(model), [](int, int) { return true; }, std::move(allowed));
  found.path = search_path(path, Sought::load, search, found.associated, may_continue);
  return found;
}

// 12 bricks, 1.0 x 0.8 m, friction angle 37.7 degrees. The blocks right of the steps from the lower right corner turn
// about it without friction: joints left of them open. With arms from the corner and heights of their centres, by length
// and course,
//   holding     0.2 x 0.1 + 0.4 x 0.2 + 0.6 x 0.3 + 0.8 x 0.4 = 0.60
//   overturning 0.2 x 0.1 + 0.4 x 0.3 + 0.6 x 0.5 + 0.8 x 0.7 = 1.00
// so that they turn from 0.60 of their weight on. Joints that dilate hold up to 0.675.
TEST(PathSearch, WallRocksAboutItsStepsWhereDilationWouldHoldIt) {
  const Found found = capacity_of(pushed_wall(running_bond(1.0, 4), tangent_of(37.7)));
  ASSERT_TRUE(found.path.lower && found.path.upper);
  EXPECT_LE(*found.path.lower, 0.60 * 1.001);
  EXPECT_GE(*found.path.upper, 0.60 * 0.995);
  EXPECT_GT(*found.associated.lower, 0.66);
  ASSERT_TRUE(found.path.motion.has_value());
  EXPECT_TRUE(found.path.proven);
}

TEST(PathSearch, MonolithSlidesOrTopplesByHand) {
  // 0.4 x 0.2 x 0.8 m: topples at 0.5 of its weight, or slides at its friction.
  const std::vector<BoxOfWall> pier = {{{0.0, 0.0, 0.0}, {0.4, 0.2, 0.8}}};
  for (const auto& [friction, limit] : {std::pair(0.7, 0.5), std::pair(0.4, 0.4)}) {
    const Found found = capacity_of(pushed_wall(pier, friction));
    ASSERT_TRUE(found.path.lower && found.path.upper) << friction;
    EXPECT_LE(*found.path.lower, limit * 1.001);
    EXPECT_GE(*found.path.upper, limit * 0.999);
  }
}

TEST(PathSearch, FactorOfASlopeHasItsOnsetAtTheEnd) {
  const LimitScene scene = on_slope(30.0, joint(tangent_of(36.0)), 0);
  const double exact = tangent_of(36.0) / tangent_of(30.0);
  const Simulation simulation = scene.build();
  RigidModel model = simulation.spring_model(1.0);
  LoadPath path(std::move(model), [](int, int) { return true; }, {0.01});
  const LimitSearch search{0.1, 10.0, 1e-3};
  const auto may_continue = [] { return true; };
  const LimitBracket associated = scene.analysis().strength_factor(search, may_continue).associated;
  const PathAnswer found = search_path(path, Sought::strength, search, associated, may_continue);
  ASSERT_TRUE(found.lower && found.upper && found.onset);
  EXPECT_LE(*found.lower, exact * (1.0 + 1e-6));
  EXPECT_GE(*found.upper, exact * (1.0 - 1e-6));
  EXPECT_NEAR(*found.onset, exact, 0.02);
  EXPECT_LT(found.displacement, 1e-4);
}

TEST(PathSearch, StopsWhenItIsToldTo) {
  const LimitScene scene = on_slope(30.0, joint(0.7), 0);
  RigidModel model = scene.build().spring_model(1.0);
  LoadPath path(std::move(model), [](int, int) { return true; }, {0.01});
  const PathAnswer found = search_path(path, Sought::strength, {0.1, 10.0, 1e-3}, {}, [] { return false; });
  EXPECT_TRUE(found.interrupted);
}

}  // namespace
}  // namespace ashlar::path_search_test

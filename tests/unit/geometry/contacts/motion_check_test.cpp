#include "geometry/contacts/motion_check.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>

#include "geometry/solid/shapes.hpp"

namespace ashlar::motion_check_test {
namespace {

const MotionLimits limits{1e-6, 1e-3};

/// A solid before and after a step.
struct Mover {
  Polyhedron solid;
  SubFaceSurface surface;
  PlacedSurface start;
  PlacedSurface end;
  Mover(Polyhedron polyhedron, const Eigen::Isometry3d& motion)
      : solid(std::move(polyhedron)),
        surface(whole_surface(solid)),
        start(surface, surface.points),
        end(surface, moved(surface.points, motion)) {}
  Mover(const Mover&) = delete;
  Mover& operator=(const Mover&) = delete;
  [[nodiscard]] MovingSurface moving() const { return {&start, &end}; }

 private:
  static std::vector<Vector3> moved(std::vector<Vector3> points, const Eigen::Isometry3d& motion) {
    for (Vector3& point : points) point = motion * point;
    return points;
  }
};

Eigen::Isometry3d shift(const Vector3& by) {
  return Eigen::Isometry3d(Eigen::Translation3d(by));
}

Polyhedron box(const Vector3& low, const Vector3& high) {
  return Polyhedron(make_box(low, high));
}

Polyhedron turned(const Polyhedron& solid, const Eigen::Quaterniond& turn, const Vector3& by) {
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(turn * point + by);
  return solid.with_points(std::move(points));
}

double first_share(const Mover& a, const Mover& b) {
  const auto touches = find_touches(a.moving(), b.moving(), {}, limits);
  double first = 2.0;
  for (const Touch& touch : touches) first = std::min(first, touch.share);
  return first;
}

TEST(MotionCheck, ACubeThroughAThinPlateTouchesWhenTheGapIsGone) {
  // 0.5 m in the step over a gap of 0.1 m: first touch at 0.2, in front of a plate 0.01 m thick.
  const Mover plate(box({-2, -2, -0.01}, {2, 2, 0}), shift({0, 0, 0}));
  const Mover cube(box({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1}), shift({0, 0, -0.5}));
  EXPECT_NEAR(first_share(cube, plate), 0.2, 1e-5);
  EXPECT_LE(first_share(cube, plate), 0.2);
  EXPECT_NEAR(first_share(plate, cube), 0.2, 1e-5);
}

TEST(MotionCheck, AMissIsNoTouch) {
  const Mover plate(box({-2, -2, -0.01}, {2, 2, 0}), shift({0, 0, 0}));
  EXPECT_EQ(first_share(Mover(box({2.01, -0.5, 0.1}, {3.01, 0.5, 1.1}), shift({0, 0, -2})), plate), 2.0);
  EXPECT_EQ(first_share(Mover(box({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1}), shift({0, 0, -0.0999})), plate), 2.0);
  EXPECT_EQ(first_share(Mover(box({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1}), shift({7, 0, 0.5})), plate), 2.0);
  // Both move together: no collision at any distance.
  const Mover flying_plate(box({-2, -2, -0.01}, {2, 2, 0}), shift({30, 20, -40}));
  EXPECT_EQ(first_share(Mover(box({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1}), shift({30, 20, -40})), flying_plate),
            2.0);
}

TEST(MotionCheck, CrossedRodsThatOnlyEdgesCanStop) {
  // Two square rods turned by 45 degrees about their own axes, at right angles: their ridges meet, no vertex
  // comes near a face. Ridges are 2 sqrt(1/2) = 1.41421 apart less the height 2.
  const Eigen::Quaterniond about_y(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3::UnitY()));
  const Eigen::Quaterniond about_x(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3::UnitX()));
  const Mover below(turned(box({-0.5, -5, -0.5}, {0.5, 5, 0.5}), about_y, {0, 0, 0}), shift({0, 0, 0}));
  const Mover above(turned(box({-5, -0.5, -0.5}, {5, 0.5, 0.5}), about_x, {0, 0, 2}), shift({0, 0, -4}));
  const double expected = (2.0 - std::sqrt(2.0)) / 4.0;
  const auto touches = find_touches(above.moving(), below.moving(), {}, limits);
  ASSERT_FALSE(touches.empty());
  const auto first = std::min_element(touches.begin(), touches.end(),
                                      [](const Touch& p, const Touch& q) { return p.share < q.share; });
  EXPECT_NEAR(first->share, expected, 1e-5);
  const auto* edge = std::get_if<EdgeContact>(&first->contact);
  ASSERT_NE(edge, nullptr);
  EXPECT_LT((edge->normal - Vector3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(edge->gap, 2.0 - std::sqrt(2.0), 1e-9);
}

TEST(MotionCheck, TurnedAndMovedScenesTouchAtTheSameTime) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3(1, 2, -0.5).normalized()));
  const Vector3 by(100, -40, 3);
  const Mover plate(turned(box({-2, -2, -0.01}, {2, 2, 0}), turn, by), shift({0, 0, 0}));
  const Mover cube(turned(box({-0.5, -0.5, 0.1}, {0.5, 0.5, 1.1}), turn, by),
                   shift(turn * Vector3(0, 0, -0.5)));
  EXPECT_NEAR(first_share(cube, plate), 0.2, 1e-5);
}

TEST(MotionCheck, SidesAlongEachOtherMeetAtTheirEndsOnly) {
  // A box hangs over the end of a shelf, its lower side on the shelf's upper one but for rounding of either
  // sign and any direction, and comes down along the shelf's end: which way their lines cross is rounding.
  // Its corners meet the shelf, and its short sides cross the shelf's one.
  const Polyhedron shelf = box({-2, -1, -1}, {0, 1, 0});
  const auto along_y = [](const Mover& mover, const CrossedSide& side) {
    const Vector3 along = mover.surface.points[static_cast<std::size_t>(side.ends[1])] -
                          mover.surface.points[static_cast<std::size_t>(side.ends[0])];
    return std::abs(along.y()) > 0.5 * along.norm();
  };
  for (const double error : {-1e-16, 0.0, 1e-16}) {
    for (const double lean : {-1e-16, 0.0, 1e-16}) {
      std::vector<Vector3> points = box({0, -0.5, 0}, {1, 0.5, 1}).mesh().points;
      for (Vector3& point : points) point.x() += error + lean * point.y();
      const Mover below(shelf, shift({0, 0, 0}));
      const Mover above(shelf.with_points(points), shift({0, 0, -1e-5}));
      const auto touches = find_touches(above.moving(), below.moving(), {}, limits);
      EXPECT_FALSE(touches.empty());
      for (const Touch& touch : touches) {
        const auto* edges = std::get_if<EdgeContact>(&touch.contact);
        EXPECT_FALSE(edges && along_y(above, edges->of_a) && along_y(below, edges->of_b))
            << error << " " << lean;
      }
    }
  }
  // Ridges along each other meet too: at the corners that pass through the slopes.
  const Eigen::Quaterniond on_edge(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vector3::UnitY()));
  const Mover low(turned(box({-1, -2, -1}, {0, 2, 0}), on_edge, {0, 0, 0}), shift({0, 0, 0}));
  const Mover high(turned(box({0, -1, 0}, {1, 1, 1}), on_edge.conjugate(), {0, 0, 1e-4}),
                   shift({0, 0, -0.1}));
  EXPECT_LT(first_share(high, low), 1.1e-3);
}

TEST(MotionCheck, SidesCrossBetweenTheirEndsOnly) {
  // Diagonal neighbours in a grid: their sides meet in corners, as many as rounding lets cross.
  const Polyhedron low = box({0, 0, 0}, {1, 1, 1});
  for (const Vector3& place : {Vector3(1, 0, 1), Vector3(1, 1, 1)}) {
    std::mt19937_64 random(20261122);
    for (int k = 0; k < 20; ++k) {
      std::vector<Vector3> points = box(place, place + Vector3::Ones()).mesh().points;
      for (Vector3& point : points)
        for (double& x : point) x += 1e-16 * static_cast<double>(static_cast<int>(random() % 3) - 1);
      const Mover below(low, shift({0, 0, 0}));
      const Mover above(low.with_points(points), shift({-1e-5, 2e-5, -3e-5}));
      for (const Touch& touch : find_touches(above.moving(), below.moving(), {}, limits))
        EXPECT_TRUE(std::holds_alternative<VertexContact>(touch.contact));
    }
  }
}

TEST(MotionCheck, ACornerThatPassesThroughAPlateAndOutOfItsSight) {
  // The corner ends behind the plate and beside it: neither end of the way shows a penetration.
  const Mover plate(box({-2, -2, -0.01}, {2, 2, 0}), shift({0, 0, 0}));
  const Eigen::Quaterniond upright =
      Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1).normalized(), Vector3(0, 0, -1));
  const Mover cube(turned(box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}), upright, {1.5, 0, 0.5}),
                   shift({0.8, 0, -0.8}));
  const double share = first_share(cube, plate);
  // The corner starts at height 0.5 - 0.05 sqrt(3).
  EXPECT_NEAR(share, (0.5 - 0.05 * std::sqrt(3.0)) / 0.8, 1e-4);
}

TEST(MotionCheck, KnownContactsStandForTheirFeatures) {
  const Mover floor(box({-2, -2, -1}, {2, 2, 0}), shift({0, 0, 0}));
  const Mover cube(box({-0.5, -0.5, 1e-4}, {0.5, 0.5, 1}), shift({0.01, 0, -2e-4}));
  const PairContacts known = find_contacts(cube.start, floor.start, {1e-3, 1e-3, 0.1});
  ASSERT_FALSE(known.empty());
  EXPECT_TRUE(find_touches(cube.moving(), floor.moving(), known, limits).empty());
  EXPECT_FALSE(find_touches(cube.moving(), floor.moving(), {}, limits).empty());
}

// A plate that leans on one corner falls through the floor: the known contact of that corner stands for none
// of the seven others, 0.1 m away or more, whichever block comes first and however the scene lies.
TEST(MotionCheck, KnownContactsStandForNothingFarFromThem) {
  const Eigen::Quaterniond lean(Eigen::AngleAxisd(0.02, Vector3(1, 1, 0).normalized()));
  for (int k = 0; k < 20; ++k) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3 * k, Vector3(1, 2, 0.1 * k).normalized()));
    const Vector3 down = turn * Vector3(0, 0, -0.2);
    const Polyhedron plate = turned(box({0, 0, 0}, {1, 1, 0.1}), lean, Vector3::Zero());
    double lowest = 1.0;
    for (const Vector3& point : plate.mesh().points) lowest = std::min(lowest, point.z());
    const Mover leaning(turned(plate, turn, turn * Vector3(0, 0, 5e-4 - lowest)), shift(down));
    const Mover floor(turned(box({-2, -2, -1}, {2, 2, 0}), turn, Vector3::Zero()), shift({0, 0, 0}));
    for (const bool floor_first : {false, true}) {
      const Mover& a = floor_first ? floor : leaning;
      const Mover& b = floor_first ? leaning : floor;
      const PairContacts known = find_contacts(a.start, b.start, {1e-3, 1e-3, 0.01});
      ASSERT_EQ(known.vertices.size(), 1U) << k;
      ASSERT_TRUE(known.overlaps.empty() && known.edges.empty()) << k;
      std::vector<int> corners;
      for (const Touch& touch : find_touches(a.moving(), b.moving(), known, limits)) {
        const auto* vertex = std::get_if<VertexContact>(&touch.contact);
        if (vertex != nullptr && vertex->vertex_of_a != floor_first) corners.push_back(vertex->point);
      }
      EXPECT_EQ(corners.size(), 7U) << k << floor_first;
      EXPECT_EQ(std::count(corners.begin(), corners.end(), known.vertices[0].point), 0) << k << floor_first;
    }
  }
}

TEST(MotionCheck, RandomFlightsAreCaughtBeforeTheyTouch) {
  // Two cubes fly at each other's centres: a touch must be found, no later than their true first touch, which
  // a fine sampling of their overlap along the axes of the first gives from above.
  std::uint64_t seed = 12345;
  const auto number = [&] {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(seed >> 11) * 0x1p-52 - 1.0;
  };
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Quaterniond turn(Eigen::Quaterniond(number(), number(), number(), number()).normalized());
    const Vector3 from = 3.0 * Vector3(number(), number(), number()).normalized();
    const Mover still(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), shift({0, 0, 0}));
    const Mover flying(turned(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), turn, from), shift(-2.0 * from));
    const double share = first_share(flying, still);
    // Centres 3 apart; the cubes' inscribed spheres touch at a distance of 1 at the latest.
    EXPECT_LE(share, (3.0 - 1.0) / 6.0);
    // Their circumscribed spheres not before a distance of sqrt(3).
    EXPECT_GE(share, (3.0 - std::sqrt(3.0)) / 6.0 - 1e-6);
  }
}

}  // namespace
}  // namespace ashlar::motion_check_test

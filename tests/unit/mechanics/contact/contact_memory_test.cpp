#include "mechanics/contact/contact_memory.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace ashlar::contact_memory_test {
namespace {

constexpr double never = -std::numeric_limits<double>::infinity();

ContactPoint point_at(const Vector3& material_a, const Vector3& material_b, int face_b,
                      const Vector3& normal) {
  ContactPoint point{};
  point.type = ContactPointType::vertex_face;
  point.face_a = 3;
  point.face_b = face_b;
  point.material_a = material_a;
  point.material_b = material_b;
  point.normal = normal.normalized();
  point.area = 0.25;
  return point;
}

PointMemory slipped(const Vector3& slip) {
  PointMemory memory;
  memory.slip = slip;
  memory.state = ContactState::locked;
  memory.intact = true;
  return memory;
}

TEST(ContactMemory, SlipGoesWithAVertexOverAnEdgeThatIsNotSharpAndABondDoesNot) {
  ContactMemory memory;
  memory.store({point_at({0, 0, 1}, {0.99, 0, 0}, 7, {0, 0, 1})}, {slipped({3e-6, 4e-6, 0})}, 0.0, {});
  // The same vertex, on a face that leans by 45 degrees about y: x turns into the plane, lengths stay.
  const PointMemory next = memory.recall({point_at({0, 0, 1}, {1.01, 0, 0}, 8, {1, 0, 1})}, never)[0];
  EXPECT_NEAR(next.slip.norm(), 5e-6, 1e-18);
  EXPECT_NEAR(next.slip.dot(Vector3(1, 0, 1)), 0.0, 1e-18);
  EXPECT_GT(next.slip.x(), 0.0);
  EXPECT_EQ(next.state, ContactState::locked);
  EXPECT_FALSE(next.intact);
}

/// The surfaces at an intact bond are apart by its dilation and its opening; a point that is open, or whose bond has failed,
/// transmits nothing across its gap.
TEST(ContactMemory, ABondInTensionReachesAcrossItsOpening) {
  const auto most_of = [](ContactState state, bool intact) {
    PointMemory point = slipped({1e-6, 0, 0});
    point.dilation = 2e-3;
    point.compression = -5e-3;
    point.state = state;
    point.intact = intact;
    ContactMemory memory;
    memory.store({point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1})}, {point}, 0.0, {});
    return memory.most_dilation();
  };
  EXPECT_EQ(most_of(ContactState::locked, true), 7e-3);
  EXPECT_EQ(most_of(ContactState::sliding, true), 7e-3);
  EXPECT_EQ(most_of(ContactState::open, true), 2e-3);
  EXPECT_EQ(most_of(ContactState::locked, false), 2e-3);
}

TEST(ContactMemory, DilationGoesWithSlip) {
  PointMemory low = slipped({1e-6, 0, 0}), high = low;
  low.dilation = 2e-3;
  high.dilation = 4e-3;
  high.level_dilation = 1e-3;
  ContactMemory memory;
  memory.store(
      {point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1}), point_at({0.2, 0, 1}, {0.2, 0, 0}, 7, {0, 0, 1})},
      {low, high}, 0.0, {});
  EXPECT_EQ(memory.most_dilation(), 4e-3);
  const PointMemory between = memory.recall({point_at({0.1, 0, 1}, {0.1, 0, 0}, 7, {0, 0, 1})}, never)[0];
  EXPECT_NEAR(between.dilation, 3e-3, 1e-15);
  EXPECT_NEAR(between.level_dilation, 0.5e-3, 1e-15);
  memory.start_level();
  EXPECT_EQ(memory.recall({point_at({0.2, 0, 1}, {0.2, 0, 0}, 7, {0, 0, 1})}, never)[0].level_dilation, 4e-3);
}

TEST(ContactMemory, ASharpEdgeIsAnotherContact) {
  ContactMemory memory;
  memory.store({point_at({0, 0, 1}, {0.99, 0, 0}, 7, {0, 0, 1})}, {slipped({3e-6, 4e-6, 0})}, 0.0, {});
  EXPECT_EQ(memory.recall({point_at({0, 0, 1}, {1, 0, -0.01}, 8, {1, 0, 0})}, never)[0].slip.norm(), 0.0);
}

TEST(ContactMemory, APointFarFromAllOldOnesStartsAnew) {
  // One point of 0.25 m^2: it speaks for half a metre about it.
  ContactMemory memory;
  memory.store({point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1})}, {slipped({1e-6, 0, 0})}, 0.0, {});
  EXPECT_EQ(memory.recall({point_at({0.4, 0, 1}, {0.4, 0, 0}, 7, {0, 0, 1})}, never)[0].slip.x(), 1e-6);
  const PointMemory far = memory.recall({point_at({0.6, 0, 1}, {0.6, 0, 0}, 7, {0, 0, 1})}, never)[0];
  EXPECT_EQ(far.slip.norm(), 0.0);
  EXPECT_EQ(far.state, ContactState::open);
  EXPECT_FALSE(far.intact);
}

TEST(ContactMemory, ASlidingPointIsKnownByWhatItCarriesAlong) {
  // Two vertices in a row slide by their distance: the second one is now where the first one was.
  ContactMemory memory;
  memory.store(
      {point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1}), point_at({0.3, 0, 1}, {0.3, 0, 0}, 7, {0, 0, 1})},
      {slipped({1e-6, 0, 0}), slipped({2e-6, 0, 0})}, 0.0, {});
  const auto next = memory.recall(
      {point_at({0, 0, 1}, {0.05, 0, 0}, 7, {0, 0, 1}), point_at({0.3, 0, 1}, {0.35, 0, 0}, 7, {0, 0, 1})},
      never);
  EXPECT_EQ(next[0].slip.x(), 1e-6);
  EXPECT_EQ(next[1].slip.x(), 2e-6);
  EXPECT_TRUE(next[0].intact && next[1].intact);
}

// A point that is new in the middle of four others has their mean, not that of the one that rounding calls
// the nearest.
TEST(ContactMemory, APointInTheMiddleOfOthersHasTheirMean) {
  const std::vector<Vector3> corners = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const std::vector<Vector3> slips = {{4e-6, 0, 0}, {0, 8e-6, 0}, {-4e-6, 0, 0}, {0, 4e-6, 0}};
  for (const double off : {0.0, 1e-12, -1e-12}) {
    std::vector<ContactPoint> points;
    std::vector<PointMemory> memories;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      points.push_back(point_at(corners[k], corners[k], 7, {0, 0, 1}));
      points.back().area = 1.0;
      memories.push_back(slipped(slips[k]));
      memories.back().compression = 1e-6 * static_cast<double>(k);
    }
    memories[3].intact = false;
    ContactMemory memory;
    memory.store(points, memories, 0.0, {});
    const Vector3 middle{off, -off, 0};
    const PointMemory mean = memory.recall({point_at(middle, middle, 7, {0, 0, 1})}, never)[0];
    EXPECT_LT((mean.slip - Vector3(0, 3e-6, 0)).norm(), 1e-16) << off;
    EXPECT_NEAR(mean.compression, 1.5e-6, 1e-16) << off;
    EXPECT_TRUE(mean.intact);
    // A crack that has taken half of them has reached the middle.
    memories[2].intact = false;
    memory.store(points, memories, 0.0, {});
    EXPECT_FALSE(memory.recall({point_at(middle, middle, 7, {0, 0, 1})}, never)[0].intact) << off;
  }
}

TEST(ContactMemory, SliversAreNotAsked) {
  ContactMemory memory;
  auto points = std::vector{point_at({0, 0, 0}, {0, 0, 0}, 7, {0, 0, 1}),
                            point_at({0.1, 0, 0}, {0.1, 0, 0}, 7, {0, 0, 1})};
  points[0].area = 1.0;
  const auto slip_beside_area = [&](double area) {
    points[1].area = area;
    memory.store(points, {slipped({1e-6, 0, 0}), slipped({3e-6, 0, 0})}, 0.0, {});
    return memory.recall({point_at({0.1, 0, 0}, {0.1, 0, 0}, 7, {0, 0, 1})}, never)[0].slip.x();
  };
  EXPECT_EQ(slip_beside_area(1e-3), 3e-6);
  EXPECT_EQ(slip_beside_area(1e-8), 1e-6);
}

// Between two points, memory passes from one to the other without a jump; near one it is that one's.
TEST(ContactMemory, MemoryPassesFromOnePointToTheNextWithoutAJump) {
  ContactMemory memory;
  auto points =
      std::vector{point_at({0, 0, 0}, {0, 0, 0}, 7, {0, 0, 1}), point_at({1, 0, 0}, {1, 0, 0}, 7, {0, 0, 1})};
  points[0].area = points[1].area = 1.0;
  memory.store(points, {slipped({1e-6, 0, 0}), slipped({3e-6, 0, 0})}, 0.0, {});
  const auto slip_at = [&](double x) {
    return memory.recall({point_at({x, 0, 0}, {x, 0, 0}, 7, {0, 0, 1})}, never)[0].slip.x();
  };
  EXPECT_EQ(slip_at(0.39), 1e-6);
  EXPECT_EQ(slip_at(0.61), 3e-6);
  EXPECT_NEAR(slip_at(0.5), 2e-6, 1e-16);
  // From one to the other within 0.2 m, nowhere three times as fast as on the way.
  for (int k = 390; k < 610; ++k) {
    const double x = 1e-3 * k;
    EXPECT_GE(slip_at(x + 1e-3), slip_at(x) - 1e-20) << x;
    EXPECT_LT(slip_at(x + 1e-3) - slip_at(x), 3e-8) << x;
  }
}

TEST(ContactMemory, ForcesOfAPointThatGrowsAreKeptWhereTheyAreToBe) {
  PointMemory pressed = slipped({0, 0, 0});
  pressed.normal_multiplier = 8.0;  // Pa, on 0.25 m^2
  pressed.shear_multiplier = {3.0, 0, 0};
  ContactMemory memory;
  memory.store({point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1})}, {pressed}, 0.0, {});
  ContactPoint grown = point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1});
  grown.area = 0.5;
  EXPECT_EQ(memory.recall({grown}, never)[0].normal_multiplier, 8.0);
  EXPECT_EQ(memory.recall({grown}, never, true)[0].normal_multiplier, 4.0);
  EXPECT_EQ(memory.recall({grown}, never, true)[0].shear_multiplier.x(), 1.5);
  // One that became two would give its force twice.
  EXPECT_EQ(memory.recall({grown, grown}, never, true)[1].normal_multiplier, 8.0);
}

TEST(ContactMemory, NewPointsAreBondedByTheirGap) {
  const auto points = std::vector{point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1})};
  EXPECT_TRUE(ContactMemory().recall(points, 1e-3)[0].intact);
  EXPECT_FALSE(ContactMemory().recall(points, never)[0].intact);
}

/// Four points around the origin, with friction along the given directions.
void store_around(ContactMemory& memory, const std::array<Vector3, 4>& directions, ContactState state,
                  ContactState state_of_last) {
  const std::array<Vector3, 4> places{Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(-1, 0, 0),
                                      Vector3(0, -1, 0)};
  std::vector<ContactPoint> points;
  std::vector<PointMemory> memories;
  for (std::size_t k = 0; k < places.size(); ++k) {
    points.push_back(point_at(places[k], places[k], 7, {0, 0, 1}));
    memories.push_back(slipped(1e-6 * directions[k]));
    memories.back().state = k == 3 ? state_of_last : state;
  }
  memory.store(points, memories, 0.0, {}, 0.0, {}, memory.turning());
}

TEST(ContactMemory, FrictionTurnsOverAFaceThatTwistsOnceAllOfItSlides) {
  const std::array<Vector3, 4> around{Vector3(0, 1, 0), Vector3(-1, 0, 0), Vector3(0, -1, 0),
                                      Vector3(1, 0, 0)};
  const std::array<Vector3, 4> along{Vector3(1, 0, 0), Vector3(1, 0, 0), Vector3(1, 0, 0), Vector3(1, 0, 0)};
  ContactMemory memory;
  store_around(memory, around, ContactState::sliding, ContactState::locked);
  EXPECT_TRUE(memory.turning().empty());
  store_around(memory, around, ContactState::sliding, ContactState::sliding);
  EXPECT_EQ(memory.turning(), (std::vector<FacePair>{{3, 7}}));
  // It continues while directions differ, also without sliding points.
  store_around(memory, around, ContactState::locked, ContactState::locked);
  EXPECT_EQ(memory.turning().size(), 1U);
  store_around(memory, along, ContactState::sliding, ContactState::sliding);
  EXPECT_TRUE(memory.turning().empty());
  // Points that are open do not count.
  store_around(memory, around, ContactState::sliding, ContactState::open);
  EXPECT_EQ(memory.turning().size(), 1U);
}

TEST(ContactMemory, FrictionOfTwoFacesDoesNotTurnBecauseTheirPlanesDiffer) {
  // A wedge that slides along y in a groove, and one that twists by as little as 10 degrees to both sides.
  ContactMemory memory;
  std::vector<PointMemory> sliding{slipped({0, 1e-6, 0}), slipped({0, -1e-6, 0})};
  for (PointMemory& one : sliding) one.state = ContactState::sliding;
  memory.store({point_at({0, 0, 0}, {0, 0, 0}, 7, {1, 0, 1}), point_at({1, 0, 0}, {1, 0, 0}, 8, {-1, 0, 1})},
               sliding, 0.0, {});
  EXPECT_TRUE(memory.turning().empty());
  const double angle = 10.0 * 3.141592653589793 / 180.0;
  sliding[0].slip = 1e-6 * Vector3(std::cos(angle), std::sin(angle), 0);
  sliding[1].slip = 1e-6 * Vector3(std::cos(angle), -std::sin(angle), 0);
  memory.store({point_at({0, 0, 0}, {0, 0, 0}, 7, {0, 0, 1}), point_at({1, 0, 0}, {1, 0, 0}, 7, {0, 0, 1})},
               sliding, 0.0, {});
  EXPECT_TRUE(memory.turning().empty());  // the mean has the length cos 10 = 0.985
}

}  // namespace
}  // namespace ashlar::contact_memory_test

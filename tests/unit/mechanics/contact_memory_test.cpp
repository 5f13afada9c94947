#include "mechanics/contact_memory.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ashlar {
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

TEST(ContactMemory, NewPointsAreBondedByTheirGap) {
  const auto points = std::vector{point_at({0, 0, 1}, {0, 0, 0}, 7, {0, 0, 1})};
  EXPECT_TRUE(ContactMemory().recall(points, 1e-3)[0].intact);
  EXPECT_FALSE(ContactMemory().recall(points, never)[0].intact);
}

}  // namespace
}  // namespace ashlar

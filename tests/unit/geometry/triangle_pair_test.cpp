#include "geometry/triangle_pair.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/convex_contact.hpp"

namespace ashlar {
namespace {

TrianglePairType by_full_report(const TriangleCorners& a, const TriangleCorners& b) {
  const ConvexContact contact =
      classify(ConvexShape::from_triangle(a[0], a[1], a[2]), ConvexShape::from_triangle(b[0], b[1], b[2]));
  const ContactRegion& r = contact.region;
  return {contact.relation, r.type, r.a_dimension, r.b_dimension, r.dimension};
}

bool collinear(const TriangleCorners& t) {
  PredicateLadder ladder;
  return is_zero(ContactDirection::cross({&t[1], &t[0]}, {&t[2], &t[0]}), ladder);
}

// Corners are drawn from `steps` values per axis: few of them make touching and parallel triangles common.
void compare(unsigned steps, double scale, int count) {
  std::mt19937_64 random(steps);
  for (int k = 0; k < count; ++k) {
    std::array<TriangleCorners, 2> t;
    for (TriangleCorners& corners : t)
      for (Vector3& p : corners)
        for (int i = 0; i < 3; ++i) p[i] = scale * static_cast<double>(random() % steps);
    if (collinear(t[0]) || collinear(t[1])) continue;
    EXPECT_EQ(classify_triangles(t[0], t[1]), by_full_report(t[0], t[1])) << "pair " << k;
  }
}

TEST(TrianglePair, AgreesWithTheFullReport) {
  compare(3, 1.0, 3000);
  compare(5, 1.0, 3000);
  compare(1U << 20, 1.0, 3000);
}

TEST(TrianglePair, AgreesWithTheFullReportAtTheEndsOfTheRange) {
  compare(4, 0x1p-1070, 500);
  compare(4, 0x1p1000, 500);
  compare(1U << 20, 0x1p-300, 500);
}

TEST(TrianglePair, ByHand) {
  const TriangleCorners floor{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)};
  const auto type = [&](const TriangleCorners& b) { return classify_triangles(floor, b).type; };
  EXPECT_EQ(type({Vector3(1, 1, 1), Vector3(1, 1, 3), Vector3(2, 1, 3)}), ContactType::vertex_face);
  EXPECT_EQ(type({Vector3(1, 1, -1), Vector3(1, 1, 3), Vector3(2, 1, 3)}), ContactType::crossing);
  EXPECT_EQ(type({Vector3(1, -1, 1), Vector3(1, 1, 1), Vector3(1, 0, 5)}), ContactType::edge_face);
  EXPECT_EQ(type({Vector3(1, 1, 1), Vector3(2, 1, 1), Vector3(1, 2, 1)}), ContactType::face_face);
  EXPECT_EQ(type({Vector3(-1, -1, 0), Vector3(-1, -3, 0), Vector3(-3, -1, 2)}), ContactType::vertex_vertex);
}

}  // namespace
}  // namespace ashlar

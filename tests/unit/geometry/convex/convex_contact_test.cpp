#include "geometry/convex/convex_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cfenv>
#include <cmath>
#include <random>
#include <stdexcept>

#include "geometry/solid/shapes.hpp"

namespace ashlar::convex_contact_test {
namespace {

ConvexShape box(const Vector3& low, const Vector3& high) {
  return ConvexShape::from_mesh(make_box(low, high));
}

// Top of a double wedge: an edge along y at height 0, from y = -1 to 1, the solid above it.
ConvexShape wedge_above(double lift) {
  return ConvexShape::from_mesh(make_convex_hull(std::vector<Vector3>{{0, -1, lift},
                                                                      {0, 1, lift},
                                                                      {-1, -1, lift + 1},
                                                                      {1, -1, lift + 1},
                                                                      {-1, 1, lift + 1},
                                                                      {1, 1, lift + 1}}));
}

TEST(ConvexContact, ABoxOverABoxIsFaceToFace) {
  const ConvexShape upper = box(Vector3(0, 0, 1.5), Vector3(1, 1, 2)),
                    lower = box(Vector3(0.5, 0.5, 0), Vector3(3, 3, 1));
  const ConvexContact contact = classify(upper, lower);
  EXPECT_EQ(contact.relation, Relation::apart);
  EXPECT_EQ(contact.type(), ContactType::face_face);
  EXPECT_EQ(contact.squared_distance, 0.25);
  EXPECT_EQ(contact.displacement, Vector3(0, 0, 0.5));
  EXPECT_EQ(contact.normal, Vector3(0, 0, 1));
  EXPECT_EQ(contact.rule, DirectionRule::closest_points);
  ASSERT_EQ(contact.region.points.size(), 4U);
  double area = 0.0;  // counter-clockwise seen from above: positive
  for (std::size_t k = 0; k < 4; ++k) {
    const RegionVertex &p = contact.region.points[k], &q = contact.region.points[(k + 1) % 4];
    EXPECT_EQ(p.on_a - p.on_b, Vector3(0, 0, 0.5));
    area += 0.5 * (p.on_a[0] * q.on_a[1] - p.on_a[1] * q.on_a[0]);
  }
  EXPECT_EQ(area, 0.25);
  EXPECT_GT(contact.decided_by.filter, 0);
}

TEST(ConvexContact, TheGapIsGivenWhereAskedFor) {
  const ConvexShape lower = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  const CrossingDetail detail{true, true, true};
  EXPECT_EQ(classify(box(Vector3(2, 3, 0), Vector3(4, 4, 1)), lower, std::nullopt, detail).gap,
            std::sqrt(5.0));
  EXPECT_EQ(classify(box(Vector3(0, 0, 0.75), Vector3(1, 1, 3)), lower, std::nullopt, detail).gap, -0.25);
  EXPECT_EQ(classify(box(Vector3(0, 0, 1), Vector3(1, 1, 3)), lower, std::nullopt, detail).gap, 0.0);
}

// Independent of the filter's bounds of equal depths: facets of A first, by their numbers.
TEST(ConvexContact, EqualTranslationsComeInOrder) {
  const ConvexShape cube = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  const ConvexContact contact = classify(cube, cube);
  EXPECT_EQ(contact.squared_depth, 1.0);
  ASSERT_EQ(contact.minimal_translations.size(), 6U);
  for (int k = 0; k < 6; ++k)
    EXPECT_EQ(contact.minimal_translations[k].entrance, (Entrance{EntranceKind::face_of_a, k, -1, false}));
}

TEST(ConvexContact, OneUlpIsSeen) {
  const ConvexShape lower = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  const double above = std::nextafter(1.0, 2.0), below = std::nextafter(1.0, 0.0);
  EXPECT_EQ(classify(box(Vector3(0, 0, above), Vector3(1, 1, 2)), lower).relation, Relation::apart);
  EXPECT_EQ(classify(box(Vector3(0, 0, 1.0), Vector3(1, 1, 2)), lower).relation, Relation::touching);
  const ConvexContact crossing = classify(box(Vector3(0, 0, below), Vector3(1, 1, 2)), lower);
  EXPECT_EQ(crossing.relation, Relation::crossing);
  EXPECT_EQ(crossing.squared_depth, 0x1p-106);
  ASSERT_EQ(crossing.minimal_translations.size(), 1U);
  EXPECT_EQ(crossing.minimal_translations[0].translation, Vector3(0, 0, 0x1p-53));
  EXPECT_EQ(crossing.minimal_translations[0].region.type, ContactType::face_face);
  EXPECT_EQ(crossing.region.points.size(), 8U);
}

TEST(ConvexContact, EqualDepthsAreAllListed) {
  const ConvexShape outer = box(Vector3(0, 0, 0), Vector3(2, 2, 2)),
                    inner = box(Vector3(0.5, 0.5, 0.5), Vector3(1.5, 1.5, 1.5));
  const ConvexContact contact = classify(inner, outer);
  EXPECT_EQ(contact.squared_depth, 2.25);
  EXPECT_EQ(contact.minimal_translations.size(), 6U);
  EXPECT_EQ(contact.rule, DirectionRule::least_penetration_tie);
}

TEST(ConvexContact, TheAnswerDoesNotDependOnTheRoundingMode) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vector3(1, 1, 2).normalized()).toRotationMatrix();
  TriangleMesh mesh = make_box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  for (Vector3& p : mesh.points) p = turn * p + Vector3(0.1, 0.2, 1.7);
  const ConvexShape a = ConvexShape::from_mesh(mesh), b = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  const ConvexContact expected = classify(a, b);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const ConvexContact contact = classify(a, b);
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(contact.squared_distance, expected.squared_distance);
    EXPECT_EQ(contact.displacement, expected.displacement);
    EXPECT_EQ(contact.normal, expected.normal);
    EXPECT_EQ(contact.decided_by.filter, expected.decided_by.filter);
  }
}

TEST(ConvexContact, WorksWhereFloatingPointUnderflowsOrOverflows) {
  for (const double scale : {0x1p-1060, 0x1p-500, 0x1p400, 0x1p1000}) {
    const ConvexShape upper = box(Vector3(0, 0, 3) * scale, Vector3(1, 1, 4) * scale);
    const ConvexShape lower = box(Vector3(0, 0, 0) * scale, Vector3(1, 1, 2) * scale);
    const ConvexContact contact = classify(upper, lower);
    EXPECT_EQ(contact.type(), ContactType::face_face);
    EXPECT_EQ(contact.displacement, Vector3(0, 0, scale));
    EXPECT_EQ(contact.normal, Vector3(0, 0, 1));
    EXPECT_EQ(contact.squared_distance, scale * scale);  // 0 or infinite where that is the nearest double
    // The first or second of the smaller two powers is still in the range of doubles, so signs of that
    // degree are left to the filter; of the others none is.
    const bool has_safe_degree = scale == 0x1p-500 || scale == 0x1p400;
    EXPECT_EQ(contact.decided_by.filter > 0, has_safe_degree);
    EXPECT_GT(contact.decided_by.exact, 0);
  }
}

TEST(ConvexContact, HistoryChoosesTheNormalOfAVertexOnAVertex) {
  const ConvexShape a = box(Vector3(1, 1, 1), Vector3(2, 2, 2)), b = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  const ConvexContact fresh = classify(a, b);
  EXPECT_EQ(fresh.type(), ContactType::vertex_vertex);
  EXPECT_EQ(fresh.rule, DirectionRule::least_penetration_tie);
  // Seen apart above each other: the top of b is the entrance.
  const ConvexShape earlier = box(Vector3(0.5, 0.5, 1.25), Vector3(1.5, 1.5, 2.25));
  const std::optional<Entrance> entrance = find_entrance(earlier, b);
  ASSERT_TRUE(entrance.has_value());
  const ConvexContact known = classify(a, b, entrance);
  EXPECT_EQ(known.rule, DirectionRule::history);
  EXPECT_EQ(known.normal, Vector3(0, 0, 1));
  EXPECT_EQ(known.entrance, entrance);
  // All faces at the corner are as far across now: the one known stays.
  const Entrance side = find_entrance(box(Vector3(1.25, 0.5, 0.5), Vector3(2.25, 1.5, 1.5)), b).value();
  EXPECT_NE(side, *entrance);
  EXPECT_EQ(find_entrance(a, b, entrance), entrance);
  EXPECT_EQ(find_entrance(a, b, side), side);
}

TEST(ConvexContact, HistoryChoosesTheNormalOfACrossing) {
  // a has sunk deep into the top of b near its side: the side is nearer, the top was the entrance.
  const ConvexShape a = box(Vector3(0.75, 0.25, 0.5), Vector3(1.75, 0.75, 1.5)),
                    b = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  EXPECT_EQ(classify(a, b).normal, Vector3(1, 0, 0));
  const std::optional<Entrance> top =
      find_entrance(box(Vector3(0.75, 0.25, 1.5), Vector3(1.75, 0.75, 2.5)), b);
  const ConvexContact contact = classify(a, b, top);
  EXPECT_EQ(contact.rule, DirectionRule::history);
  EXPECT_EQ(contact.normal, Vector3(0, 0, 1));
  const ResolvedContact resolved = classify_at(a, b, {}, top);
  EXPECT_EQ(resolved.gap, -0.5);
  EXPECT_EQ(resolved.region.type, ContactType::face_face);
}

TEST(ConvexContact, HistoryThatNoLongerAppliesIsIgnored) {
  const ConvexShape a = box(Vector3(1, 1, 1), Vector3(2, 2, 2)), b = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  EXPECT_NE(classify(a, b, Entrance{EntranceKind::face_of_b, -1, 99, false}).rule, DirectionRule::history);
  EXPECT_NE(classify(a, b, Entrance{EntranceKind::edge_edge, 0, 0, false}).rule, DirectionRule::history);
}

TEST(FindEntrance, NoneWhileTheyCross) {
  const ConvexShape b = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  EXPECT_FALSE(find_entrance(box(Vector3(0.5, 0.5, 0.5), Vector3(2, 2, 2)), b).has_value());
  EXPECT_TRUE(find_entrance(box(Vector3(1, 1, 1), Vector3(2, 2, 2)), b).has_value());
}

TEST(Resolution, ATiltedBoxIsFaceToFaceOnceTheResolutionCoversItsTilt) {
  const double tilt = 0x1p-10;  // the bottom rises by tilt per unit of x
  TriangleMesh mesh = make_box(Vector3(0.25, 0.25, 1), Vector3(0.75, 0.75, 2));
  for (Vector3& p : mesh.points) p[2] += tilt * p[0];
  const ConvexShape a = ConvexShape::from_mesh(mesh), b = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  EXPECT_EQ(classify(a, b).type(), ContactType::edge_face);
  EXPECT_EQ(classify_at(a, b, {}).region.type, ContactType::edge_face);
  const double rise = 0.5 * tilt;
  EXPECT_EQ(classify_at(a, b, {std::nextafter(rise, 0.0), 0.0}).region.type, ContactType::edge_face);
  const ResolvedContact resolved = classify_at(a, b, {rise, 0.0});
  EXPECT_EQ(resolved.region.type, ContactType::face_face);
  EXPECT_EQ(resolved.region.points.size(), 4U);
  EXPECT_EQ(resolved.gap, 0.25 * tilt);
  EXPECT_EQ(resolved.normal, Vector3(0, 0, 1));
  // The sine of the tilt is just below the tilt.
  EXPECT_EQ(classify_at(a, b, {0.0, tilt}).region.type, ContactType::face_face);
  EXPECT_EQ(classify_at(a, b, {0.0, 0.99 * tilt}).region.type, ContactType::edge_face);
}

TEST(Resolution, AWedgeStaysAnEdge) {
  const ConvexShape a = wedge_above(1.0), b = box(Vector3(-4, -4, 0), Vector3(4, 4, 1));
  const ResolvedContact contact = classify_at(a, b, {0.5, 0.5});
  EXPECT_EQ(contact.relation, Relation::touching);
  EXPECT_EQ(contact.region.type, ContactType::edge_face);
}

TEST(Resolution, ZeroIsTheExactTypeAndDimensionsNeverDecrease) {
  std::mt19937_64 random(5);
  const auto lattice = [&] { return static_cast<double>(random() % 4); };
  int compared = 0;
  for (int k = 0; k < 800; ++k) {
    std::array<std::vector<Vector3>, 2> points;
    for (auto& p : points)
      for (int v = 0; v < 6; ++v) p.emplace_back(lattice(), lattice(), lattice());
    for (Vector3& p : points[0]) p[2] += static_cast<double>(random() % 5);
    try {
      const ConvexShape a = ConvexShape::from_mesh(make_convex_hull(points[0]));
      const ConvexShape b = ConvexShape::from_mesh(make_convex_hull(points[1]));
      const ConvexContact exact = classify(a, b);
      if (exact.relation == Relation::crossing) continue;
      ++compared;
      int a_dimension = exact.region.a_dimension, b_dimension = exact.region.b_dimension;
      EXPECT_EQ(classify_at(a, b, {}).region.type, exact.type());
      for (const double tau : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        const ContactRegion region = classify_at(a, b, {tau, 0.0}).region;
        EXPECT_GE(region.a_dimension, a_dimension);
        EXPECT_GE(region.b_dimension, b_dimension);
        a_dimension = region.a_dimension;
        b_dimension = region.b_dimension;
      }
    } catch (const std::invalid_argument&) {
      continue;  // coplanar points
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(Resolution, RefusesNonsense) {
  const ConvexShape b = box(Vector3(0, 0, 0), Vector3(1, 1, 1));
  EXPECT_THROW((void)classify_at(b, b, {-1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW((void)classify_at(b, b, {0.0, 1.5}), std::invalid_argument);
  EXPECT_THROW((void)classify_at(b, b, {NAN, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace ashlar::convex_contact_test

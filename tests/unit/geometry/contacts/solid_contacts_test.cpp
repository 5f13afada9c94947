#include "geometry/contacts/solid_contacts.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::solid_contacts_test {
namespace {

using ::testing::UnorderedElementsAre;

std::vector<Vector3> points_of(const ReportedContact& contact) {
  std::vector<Vector3> points;
  for (const ReportedPoint& p : contact.points) points.push_back(p.point);
  return points;
}

Vector3 normal_of(const Polyhedron& solid, const ReportedFeature& face) {
  return solid.faces().at(static_cast<std::size_t>(face.index)).normal;
}

TEST(SolidContacts, BlockInTheCornerOfAnLHasTwoContacts) {
  const Polyhedron l(test_support::make_l_prism()), block(make_box({1, 1, 0}, {2, 2, 1}));
  const ContactReport report = report_solids(block, l);
  EXPECT_EQ(report.relation, Relation::touching);
  EXPECT_FALSE(report.convex);
  ASSERT_EQ(report.contacts.size(), 2u);
  std::vector<Vector3> normals;
  for (const ReportedContact& contact : report.contacts) {
    EXPECT_EQ(contact.type, ContactType::face_face);
    EXPECT_EQ(contact.area, 1.0);
    EXPECT_EQ(contact.region_dimension, 2);
    EXPECT_EQ(contact.points.size(), 4u);
    normals.push_back(normal_of(l, contact.b));
    for (const ReportedPoint& p : contact.points) {
      EXPECT_EQ(p.gap, 0.0);
      EXPECT_EQ(p.face_of, ReportedBody::b);
      EXPECT_EQ(p.plane_normal, normals.back());
    }
  }
  EXPECT_THAT(normals, UnorderedElementsAre(Vector3(1, 0, 0), Vector3(0, 1, 0)));
}

TEST(SolidContacts, SwapExchangesTheRoles) {
  const Polyhedron l(test_support::make_l_prism()), block(make_box({1, 1, 0}, {2, 2, 1}));
  const ContactReport ab = report_solids(block, l), ba = report_solids(l, block);
  ASSERT_EQ(ab.contacts.size(), ba.contacts.size());
  for (const ReportedContact& contact : ab.contacts)
    EXPECT_TRUE(std::any_of(ba.contacts.begin(), ba.contacts.end(), [&](const ReportedContact& c) {
      return c.a == contact.b && c.b == contact.a && c.type == contact.type && c.area == contact.area &&
             points_of(c) == points_of(contact);
    }));
}

TEST(SolidContacts, LidOverAHole) {
  // The region has an outer boundary and a hole; corners of both are its vertices, diagonals are not.
  const Polyhedron frame(test_support::make_frame()), lid(make_box({-1, -1, 1}, {4, 4, 2}));
  const ContactReport report = report_solids(lid, frame);
  ASSERT_EQ(report.contacts.size(), 1u);
  const ReportedContact& contact = report.contacts[0];
  EXPECT_EQ(contact.type, ContactType::face_face);
  EXPECT_EQ(contact.area, 8.0);
  EXPECT_THAT(points_of(contact),
              UnorderedElementsAre(Vector3(0, 0, 1), Vector3(3, 0, 1), Vector3(3, 3, 1), Vector3(0, 3, 1),
                                   Vector3(1, 1, 1), Vector3(2, 1, 1), Vector3(2, 2, 1), Vector3(1, 2, 1)));
  for (const ReportedPoint& p : contact.points) {
    EXPECT_EQ(p.pair, PairKind::face_vertex);
    EXPECT_EQ(p.face_of, ReportedBody::a);
    EXPECT_EQ(p.plane_normal, Vector3(0, 0, -1));
  }
}

TEST(SolidContacts, DividedFacesGiveTheSameContact) {
  TriangleMesh divided = test_support::make_divided_cube(3);
  for (Vector3& p : divided.points) p += Vector3(0.5, 0.25, 1);
  const ContactReport report = report_solids(Polyhedron(divided), Polyhedron(make_box({0, 0, 0}, {1, 1, 1})));
  ASSERT_EQ(report.contacts.size(), 1u);
  const ReportedContact& contact = report.contacts[0];
  EXPECT_EQ(contact.type, ContactType::face_face);
  EXPECT_DOUBLE_EQ(contact.area, 0.5 * 0.75);
  EXPECT_THAT(points_of(contact), UnorderedElementsAre(Vector3(0.5, 0.25, 1), Vector3(1, 0.25, 1),
                                                       Vector3(1, 1, 1), Vector3(0.5, 1, 1)));
}

TEST(SolidContacts, NearestWallAtADistance) {
  const Polyhedron l(test_support::make_l_prism()), block(make_box({1.25, 1.5, 0}, {2, 2.5, 1}));
  const ContactReport report = report_solids(block, l);
  EXPECT_EQ(report.relation, Relation::apart);
  EXPECT_EQ(report.squared_distance, 0.0625);
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts[0].type, ContactType::face_face);
  EXPECT_EQ(report.contacts[0].area, 0.5);
  EXPECT_EQ(normal_of(l, report.contacts[0].b), Vector3(1, 0, 0));
  for (const ReportedPoint& p : report.contacts[0].points) {
    EXPECT_EQ(p.gap, 0.25);
    EXPECT_EQ(p.point.x(), 1.25);
    EXPECT_EQ(p.foot.x(), 1.0);
  }
}

TEST(SolidContacts, TipOverAFace) {
  // The tip (1, 1, 3) is above the lower side of a block, on the diagonal of its two triangles.
  const Polyhedron pyramid(test_support::make_pyramid()), block(make_box({0, 0, 4}, {2, 2, 5}));
  const ContactReport report = report_solids(pyramid, block);
  EXPECT_EQ(report.squared_distance, 1.0);
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts[0].type, ContactType::vertex_face);
  EXPECT_EQ(report.contacts[0].a, (ReportedFeature{0, 4, {}}));
  ASSERT_EQ(report.contacts[0].points.size(), 1u);
  const ReportedPoint& p = report.contacts[0].points[0];
  EXPECT_EQ(p.pair, PairKind::vertex_face);
  EXPECT_EQ(p.foot, Vector3(1, 1, 4));
  EXPECT_EQ(p.plane_normal, Vector3(0, 0, -1));
  EXPECT_EQ(p.gap, 1.0);
}

const ReportedContact& contact_along(const ContactReport& report, const Vector3& direction) {
  const auto found = std::find_if(report.contacts.begin(), report.contacts.end(),
                                  [&](const ReportedContact& c) { return c.direction == direction; });
  EXPECT_NE(found, report.contacts.end());
  return *found;
}

TEST(SolidContacts, BlockInACornerHasAContactWithEachWall) {
  // The block is at 1/4, 1/2 and 1/8 from two walls and the floor.
  const Polyhedron room(test_support::make_corner());
  const Polyhedron block(make_box({0.25, 0.5, 0.125}, {1, 1, 1}));
  EXPECT_EQ(report_solids(block, room).contacts.size(), 1u);
  EXPECT_EQ(report_solids(block, room, 0.25).contacts.size(), 2u);
  const ContactReport report = report_solids(block, room, 0.5);
  EXPECT_EQ(report.squared_distance, 0x1p-6);
  ASSERT_EQ(report.contacts.size(), 3u);
  const std::array<double, 3> gap{0.25, 0.5, 0.125}, area{0.5 * 0.875, 0.75 * 0.875, 0.75 * 0.5};
  for (int axis = 0; axis < 3; ++axis) {
    const ReportedContact& contact = contact_along(report, Vector3::Unit(axis));
    EXPECT_EQ(contact.type, ContactType::face_face);
    EXPECT_EQ(contact.area, area[axis]);
    EXPECT_EQ(contact.squared_distance, gap[axis] * gap[axis]);
    EXPECT_EQ(contact.points.size(), 4u);
    for (const ReportedPoint& p : contact.points) {
      EXPECT_EQ(p.gap, gap[axis]);
      EXPECT_EQ(p.foot[axis], 0.0);
    }
  }
}

TEST(SolidContacts, FrameOnATurnedFrame) {
  // 3 by 3 with a hole 1 by 1 each, the upper one shifted by (1, 1): the overlap is the square [1, 3]^2
  // without the hole of the lower one, [1, 2]^2, and without that of the upper one, [2, 3]^2: two unit
  // squares that touch in (2, 2), which is one vertex. The holes also have two sides each on sides of the
  // other frame, with the frames on different sides of them: edges that touch without faces.
  TriangleMesh upper = test_support::make_frame();
  for (Vector3& p : upper.points) p += Vector3(1, 1, 1);
  const ContactReport report = report_solids(Polyhedron(upper), Polyhedron(test_support::make_frame()));
  ASSERT_EQ(report.contacts.size(), 5u);
  int edges = 0;
  for (const ReportedContact& contact : report.contacts) {
    if (contact.type == ContactType::edge_edge) {
      ++edges;
      EXPECT_EQ(contact.region_dimension, 1);
      EXPECT_EQ((contact.points[0].point - contact.points[1].point).norm(), 1.0);
      continue;
    }
    EXPECT_EQ(contact.type, ContactType::face_face);
    EXPECT_EQ(contact.area, 2.0);
    EXPECT_THAT(points_of(contact),
                UnorderedElementsAre(Vector3(2, 1, 1), Vector3(3, 1, 1), Vector3(3, 2, 1), Vector3(2, 2, 1),
                                     Vector3(1, 2, 1), Vector3(2, 3, 1), Vector3(1, 3, 1)));
  }
  EXPECT_EQ(edges, 4);
}

TEST(SolidContacts, EdgeOverAHoleHasTwoSegments) {
  // A ridge along y = 3/2, x from -1 to 4, over a frame with its hole at x from 1 to 2.
  const Polyhedron ridge(make_convex_hull(
      std::vector<Vector3>{{-1, 1.5, 1.5}, {4, 1.5, 1.5}, {-1, 1, 3}, {4, 1, 3}, {-1, 2, 3}, {4, 2, 3}}));
  const ContactReport report = report_solids(ridge, Polyhedron(test_support::make_frame()));
  ASSERT_EQ(report.contacts.size(), 1u);
  const ReportedContact& contact = report.contacts[0];
  EXPECT_EQ(contact.type, ContactType::edge_face);
  EXPECT_EQ(contact.region_dimension, 1);
  EXPECT_EQ(contact.direction, Vector3(0, 0, 1));
  EXPECT_THAT(points_of(contact), UnorderedElementsAre(Vector3(0, 1.5, 1.5), Vector3(1, 1.5, 1.5),
                                                       Vector3(2, 1.5, 1.5), Vector3(3, 1.5, 1.5)));
  for (const ReportedPoint& p : contact.points) EXPECT_EQ(p.pair, PairKind::edge_edge);
}

TEST(SolidContacts, PegInAHoleTouchesAllItsWalls) {
  const ContactReport report =
      report_solids(Polyhedron(make_box({1, 1, -1}, {2, 2, 2})), Polyhedron(test_support::make_frame()));
  ASSERT_EQ(report.contacts.size(), 4u);
  for (const ReportedContact& contact : report.contacts) {
    EXPECT_EQ(contact.type, ContactType::face_face);
    EXPECT_EQ(contact.area, 1.0);
  }
}

TEST(SolidContacts, ReflexEdgesOnlyTouch) {
  // The edge of a block along the inner edge of an L, both at 45 degrees to it: no faces meet, the segment is
  // a contact of two edges without a normal. At any distance there is none.
  const auto wedge = [](double distance) {
    return Polyhedron(make_convex_hull(std::vector<Vector3>{{1 + distance, 1 + distance, 0.25},
                                                            {1 + distance, 1 + distance, 0.75},
                                                            {1.75, 1.5, 0.25},
                                                            {1.75, 1.5, 0.75},
                                                            {1.5, 1.75, 0.25},
                                                            {1.5, 1.75, 0.75}}));
  };
  const Polyhedron l(test_support::make_l_prism());
  const ContactReport touching = report_solids(wedge(0.0), l);
  ASSERT_EQ(touching.contacts.size(), 1u);
  EXPECT_EQ(touching.contacts[0].type, ContactType::edge_edge);
  EXPECT_EQ(touching.contacts[0].region_dimension, 1);
  EXPECT_EQ(touching.contacts[0].direction, Vector3(0, 0, 0));
  const ContactReport apart = report_solids(wedge(0.125), l);
  ASSERT_EQ(apart.contacts.size(), 2u);
  for (const ReportedContact& contact : apart.contacts) EXPECT_EQ(contact.type, ContactType::edge_face);
}

TEST(SolidContacts, DistanceMustBeFinite) {
  const Polyhedron l(test_support::make_l_prism());
  EXPECT_THROW(static_cast<void>(report_solids(l, l, -1.0)), std::invalid_argument);
}

TEST(SolidContacts, NoneWhereTheSolidsCross) {
  const Polyhedron l(test_support::make_l_prism());
  const ContactReport report = report_solids(l, l);
  EXPECT_EQ(report.relation, Relation::crossing);
  EXPECT_TRUE(report.contacts.empty());
}

}  // namespace
}  // namespace ashlar::solid_contacts_test

#include "geometry/solid_contacts.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "geometry/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar {
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

TEST(SolidContacts, NoneWhereTheSolidsCross) {
  const Polyhedron l(test_support::make_l_prism());
  const ContactReport report = report_solids(l, l);
  EXPECT_EQ(report.relation, Relation::crossing);
  EXPECT_TRUE(report.contacts.empty());
}

}  // namespace
}  // namespace ashlar

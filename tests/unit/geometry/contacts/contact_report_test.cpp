#include "geometry/contacts/contact_report.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::contact_report_test {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

ReportedSolid box(const Vector3& low, const Vector3& high) {
  return ReportedSolid(Polyhedron(make_box(low, high)));
}

ReportedSolid unit_cube(const Vector3& low = Vector3::Zero()) {
  return box(low, low + Vector3::Ones());
}

ReportedSolid hull(const std::vector<Vector3>& points) {
  return ReportedSolid(Polyhedron(make_convex_hull(points)));
}

// Lower edge along x from (-1, 0, z) to (1, 0, z), widening upwards.
ReportedSolid keel(double z) {
  return hull({{-1, 0, z}, {1, 0, z}, {-1, -1, z + 2}, {-1, 1, z + 2}, {1, -1, z + 2}, {1, 1, z + 2}});
}

// Upper edge along y from (0, -1, 0) to (0, 1, 0), widening downwards.
ReportedSolid ridge() {
  return hull({{0, -1, 0}, {0, 1, 0}, {-1, -1, -2}, {1, -1, -2}, {-1, 1, -2}, {1, 1, -2}});
}

// The faces of make_box are numbered x, y, z downwards from the last pairs of triangles; z comes first.
constexpr int bottom = 0, top = 1;

TEST(ContactReport, CubesFaceToFace) {
  const ContactReport report = report_contact(unit_cube({0.5, 0.5, 1}), unit_cube());
  EXPECT_EQ(report.relation, Relation::touching);
  EXPECT_EQ(report.squared_distance, 0.0);
  ASSERT_TRUE(report.convex);
  EXPECT_EQ(report.convex->type, ContactType::face_face);
  EXPECT_EQ(report.convex->a_dimension, 2);
  EXPECT_EQ(report.convex->b_dimension, 2);
  EXPECT_EQ(report.convex->region_dimension, 2);
  EXPECT_EQ(report.convex->direction, Vector3(0, 0, 1));
  EXPECT_EQ(report.convex->rule, DirectionRule::unique);
  EXPECT_THAT(report.convex->region, UnorderedElementsAre(Vector3(0.5, 0.5, 1), Vector3(1, 0.5, 1),
                                                          Vector3(1, 1, 1), Vector3(0.5, 1, 1)));
  ASSERT_EQ(report.contacts.size(), 1u);
  const ReportedContact& contact = report.contacts[0];
  EXPECT_EQ(contact.a, (ReportedFeature{2, bottom, {}}));
  EXPECT_EQ(contact.b, (ReportedFeature{2, top, {}}));
  EXPECT_EQ(contact.area, 0.25);
  ASSERT_EQ(contact.points.size(), 4u);
  for (const ReportedPoint& p : contact.points) {
    EXPECT_EQ(p.gap, 0.0);
    EXPECT_EQ(p.point, p.foot);
    const bool corner_of_b = p.point == Vector3(1, 1, 1), corner_of_a = p.point == Vector3(0.5, 0.5, 1);
    EXPECT_EQ(p.pair, corner_of_b   ? PairKind::face_vertex
                      : corner_of_a ? PairKind::vertex_face
                                    : PairKind::edge_edge);
    EXPECT_EQ(p.face_of, corner_of_b ? ReportedBody::a : ReportedBody::b);
    EXPECT_EQ(p.plane_normal, Vector3(0, 0, corner_of_b ? -1 : 1));
    EXPECT_EQ(p.plane_point.z(), 1.0);
  }
  EXPECT_FALSE(report.hull_of_a || report.hull_of_b);
  EXPECT_EQ(report.depth, 0.0);
}

TEST(ContactReport, EdgeLyingOnAFace) {
  // The edge of the keel from x = -1 to 1 reaches over the cube, which ends at x = 0 and 1.
  const ReportedSolid a = keel(1), b = unit_cube({0, -0.5, 0});
  const ContactReport report = report_contact(a, b);
  EXPECT_EQ(report.relation, Relation::touching);
  EXPECT_EQ(report.convex->type, ContactType::edge_face);
  EXPECT_EQ(report.convex->region_dimension, 1);
  EXPECT_THAT(report.convex->region, UnorderedElementsAre(Vector3(0, 0, 1), Vector3(1, 0, 1)));
  const ReportedContact& contact = report.contacts.at(0);
  EXPECT_EQ(contact.b, (ReportedFeature{2, top, {}}));
  ASSERT_EQ(contact.a.dimension, 1);
  for (const int v : a.solid().edges().at(contact.a.index).vertices)
    EXPECT_EQ(a.solid().mesh().points[v].z(), 1.0);
  EXPECT_EQ(contact.area, 0.0);
}

TEST(ContactReport, SkewEdgesAtADistance) {
  const ReportedSolid a = keel(1), b = ridge();
  const ContactReport report = report_contact(a, b);
  EXPECT_EQ(report.relation, Relation::apart);
  EXPECT_EQ(report.squared_distance, 1.0);
  EXPECT_EQ(report.convex->type, ContactType::edge_edge);
  EXPECT_EQ(report.convex->region_dimension, 0);
  EXPECT_EQ(report.convex->direction, Vector3(0, 0, 1));
  EXPECT_THAT(report.convex->region, ElementsAre(Vector3(0, 0, 1)));
  const ReportedPoint& p = report.contacts.at(0).points.at(0);
  EXPECT_EQ(p.pair, PairKind::edge_edge);
  EXPECT_EQ(p.face_of, std::nullopt);
  EXPECT_EQ(p.point, Vector3(0, 0, 1));
  EXPECT_EQ(p.foot, Vector3(0, 0, 0));
  EXPECT_EQ(p.plane_normal, Vector3(0, 0, 1));
  EXPECT_EQ(p.gap, 1.0);
  EXPECT_GT(report.decided_by.filter, 0);
}

TEST(ContactReport, CornersNamedByThePointsOfTheMesh) {
  const ContactReport report = report_contact(unit_cube({2, 3, 4}), unit_cube());
  EXPECT_EQ(report.squared_distance, 1.0 + 4.0 + 9.0);
  EXPECT_EQ(report.convex->type, ContactType::vertex_vertex);
  EXPECT_EQ(report.contacts.at(0).a, (ReportedFeature{0, 0, {}}));
  EXPECT_EQ(report.contacts.at(0).b, (ReportedFeature{0, 7, {}}));
  EXPECT_EQ(report.contacts.at(0).points.at(0).gap, std::sqrt(14.0));
}

TEST(ContactReport, CrossingHasADepthAndTheTranslationsThatEndIt) {
  const ContactReport report = report_contact(box({0.25, 0.25, 0.75}, {0.5, 0.75, 2}), unit_cube());
  EXPECT_EQ(report.relation, Relation::crossing);
  EXPECT_EQ(report.convex->type, ContactType::crossing);
  EXPECT_EQ(report.convex->a_dimension, 3);
  EXPECT_EQ(report.convex->b_dimension, 3);
  EXPECT_EQ(report.depth, 0.25);
  EXPECT_THAT(report.minimal_translations, ElementsAre(Vector3(0, 0, 0.25)));
  EXPECT_EQ(report.convex->region.size(), 8u);
  EXPECT_TRUE(report.contacts.empty());
  // Through the middle of a face sideways, both ways are equally long.
  const ContactReport two = report_contact(box({0.25, 0.25, -1}, {0.75, 1.25, 2}), unit_cube());
  EXPECT_EQ(two.depth, 0.75);
  EXPECT_THAT(two.minimal_translations,
              UnorderedElementsAre(Vector3(0.75, 0, 0), Vector3(-0.75, 0, 0), Vector3(0, 0.75, 0)));
}

TEST(ContactReport, SwapExchangesTheRoles) {
  const ReportedSolid a = unit_cube({0.5, 0.5, 1.5}), b = box({0, 0, 0}, {3, 3, 1});
  const ContactReport ab = report_contact(a, b), ba = report_contact(b, a);
  EXPECT_EQ(ab.relation, ba.relation);
  EXPECT_EQ(ab.squared_distance, ba.squared_distance);
  EXPECT_EQ(ab.convex->type, ba.convex->type);
  EXPECT_EQ(ab.convex->direction, -ba.convex->direction);
  EXPECT_EQ(ab.contacts.at(0).a, ba.contacts.at(0).b);
  EXPECT_EQ(ab.contacts.at(0).b, ba.contacts.at(0).a);
  // All four points are corners of the small cube over the face of the other.
  for (const ReportedContact* contact : {&ab.contacts[0], &ba.contacts[0]}) {
    EXPECT_EQ(contact->area, 1.0);
    for (const ReportedPoint& p : contact->points) {
      EXPECT_EQ(p.point.z(), 1.5);
      EXPECT_EQ(p.foot.z(), 1.0);
      EXPECT_EQ(p.plane_normal, Vector3(0, 0, 1));
      EXPECT_EQ(p.gap, 0.5);
    }
  }
  EXPECT_EQ(ab.contacts[0].points[0].face_of, ReportedBody::b);
  EXPECT_EQ(ba.contacts[0].points[0].face_of, ReportedBody::a);
}

TEST(ContactReport, ResolutionTurnsAnAlmostLevelFaceIntoAFace) {
  // The lower face of a block over a wide slab is inclined by 2^-20 in both directions.
  const double t = 0x1p-20;
  const ReportedSolid a = hull({{0, 0, 1},
                                {1, 0, 1 + t},
                                {0, 1, 1 + t},
                                {1, 1, 1 + 2 * t},
                                {0, 0, 3},
                                {1, 0, 3},
                                {0, 1, 3},
                                {1, 1, 3}});
  const ReportedSolid b = box({-4, -4, 0}, {4, 4, 1});
  EXPECT_EQ(report_contact(a, b).convex->type, ContactType::vertex_face);
  const ContactReport coarse = report_contact(a, b, Resolution{0x1p-10, 0.0});
  EXPECT_EQ(coarse.relation, Relation::touching);
  EXPECT_EQ(coarse.squared_distance, 0.0);
  EXPECT_EQ(coarse.convex->type, ContactType::face_face);
  ASSERT_TRUE(coarse.resolution);
  EXPECT_EQ(coarse.resolution->distance, 0x1p-10);
  std::vector<double> gaps;
  for (const ReportedPoint& p : coarse.contacts.at(0).points) gaps.push_back(p.gap);
  EXPECT_THAT(gaps, UnorderedElementsAre(0.0, t, t, 2 * t));
  // An angle of which 2^-20 is a small part does the same.
  EXPECT_EQ(report_contact(a, b, Resolution{0.0, 0x1p-10}).convex->type, ContactType::face_face);
}

TEST(ContactReport, RotatedCubesAreTakenAsTheirHulls) {
  // No coordinate of (3, 4, 0) / 5 and (8, 15, 0) / 17 is a double.
  TriangleMesh mesh = make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (Vector3& p : mesh.points) {
    const Vector3 q(0.6 * p.x() - 0.8 * p.y(), 0.8 * p.x() + 0.6 * p.y(), p.z());
    p = Vector3(q.x(), 8.0 / 17.0 * q.y() - 15.0 / 17.0 * q.z(), 15.0 / 17.0 * q.y() + 8.0 / 17.0 * q.z());
  }
  const Polyhedron rotated(mesh);
  const ReportedSolid body(rotated);
  ASSERT_NE(body.shape(), nullptr);
  EXPECT_EQ(body.is_hull(), !rotated.convex());
  // Every facet is named after a face of the mesh that has its corners, or after those.
  for (int f = 0; f < body.shape()->facet_count(); ++f) {
    const ReportedFeature name = body.feature({2, f});
    EXPECT_NE(name.index < 0, name.points.empty());
    for (const int v : body.shape()->facet(f)) {
      const int point = body.shape()->source_points()[v];
      const auto& loop = rotated.faces().at(std::max(name.index, 0)).loops.at(0);
      const auto& points = name.index < 0 ? name.points : loop;
      EXPECT_THAT(points, ::testing::Contains(point));
    }
  }
  const double reach = std::sqrt(3.0) / 2.0;
  const ContactReport report = report_contact(body, unit_cube({reach + 1, -0.5, -0.5}));
  EXPECT_EQ(report.relation, Relation::apart);
  EXPECT_EQ(report.hull_of_a, body.is_hull());
}

TEST(ContactReport, SolidsThatAreReallyConcaveHaveNoShape) {
  // A corner lowered by a quarter leaves a valley across the top; flips would turn it into a ridge.
  TriangleMesh valley = make_box(Vector3::Zero(), Vector3::Ones());
  valley.points[7].z() = 0.75;
  TriangleMesh ridge_mesh = valley;
  const bool first_is_convex = Polyhedron(valley).convex();
  for (auto& t : ridge_mesh.triangles) {
    if (t == std::array<int, 3>{4, 5, 7}) t = {4, 5, 6};
    if (t == std::array<int, 3>{4, 7, 6}) t = {5, 7, 6};
  }
  EXPECT_NE(first_is_convex, Polyhedron(ridge_mesh).convex());
  for (const TriangleMesh& mesh : {valley, ridge_mesh}) {
    const Polyhedron solid(mesh);
    EXPECT_EQ(ReportedSolid(solid).shape() != nullptr, solid.convex());
  }
  EXPECT_EQ(ReportedSolid(Polyhedron(test_support::make_dented_cube(0.5))).shape(), nullptr);
  const ReportedSolid l{Polyhedron(test_support::make_l_prism())};
  EXPECT_FALSE(report_contact(l, unit_cube()).convex);
  EXPECT_THROW((void)report_contact(l, unit_cube(), Resolution{0.0, 0.5}), NotConvexError);
}

}  // namespace
}  // namespace ashlar::contact_report_test

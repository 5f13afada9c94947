#include "geometry/contacts/convex_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/contacts/contact_report.hpp"
#include "support/placed_bodies.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::convex_search_test {
namespace {

using Body = test_support::PlacedBody;
using test_support::box;

const ContactLimits limits{0.02, 0.02, 10.0 * std::numbers::pi / 180.0};

struct Found {
  PairContacts contacts;
  std::optional<EntranceName> entrance;
};

Found search(const Body& a, const Body& b, const std::optional<EntranceName>& history = std::nullopt) {
  Found found{find_contacts(a.placed, b.placed, limits), std::nullopt};
  if (!found.contacts.overlaps.empty()) {
    found.entrance = entrance_of_faces(found.contacts.overlaps.front());
    return found;
  }
  const ConvexSurface of_a(a.placed), of_b(b.placed);
  found.entrance = settle_convex_contacts(of_a, of_b, {history, 0.001}, found.contacts);
  return found;
}

TEST(ConvexSurface, FindsAnEdgeFromEitherEnd) {
  const Body cube(box({0, 0, 0}, {1, 2, 3}));
  const ConvexSurface convex(cube.placed);
  const std::vector<Vector3>& points = cube.surface.points;
  int edges = 0;
  for (int from = 0; from < static_cast<int>(points.size()); ++from) {
    for (int to = 0; to < static_cast<int>(points.size()); ++to) {
      const Vector3 along = points[static_cast<std::size_t>(to)] - points[static_cast<std::size_t>(from)];
      const bool along_an_axis = (along.array() != 0.0).count() == 1;
      bool turned = false, turned_back = false;
      const int edge = convex.find_edge({from, to}, turned);
      EXPECT_EQ(edge >= 0, along_an_axis) << from << " " << to;
      if (edge < 0) continue;
      ++edges;
      EXPECT_EQ(convex.find_edge({to, from}, turned_back), edge);
      EXPECT_NE(turned, turned_back);
    }
  }
  EXPECT_EQ(edges, 24);  // 12, from both ends
}

Polyhedron moved(const Polyhedron& solid, const Eigen::AngleAxisd& turn, const Vector3& shift) {
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(turn * point + shift);
  return solid.with_points(std::move(points));
}

Polyhedron divided_box(const Vector3& low, const Vector3& high) {
  TriangleMesh mesh = test_support::make_divided_cube(3);
  for (Vector3& point : mesh.points) point = low + point.cwiseProduct(high - low);
  return Polyhedron(std::move(mesh));
}

/// A square pyramid of height 1, its apex at the origin, below (1) or above (-1) its base.
Polyhedron pyramid(double up, double half_side) {
  std::vector<Vector3> points = {Vector3::Zero()};
  for (const double x : {-half_side, half_side})
    for (const double y : {-half_side, half_side}) points.emplace_back(x, y, up);
  return Polyhedron(make_convex_hull(points));
}

TEST(ConvexSearch, TipOnTipIsHeldByTheFaceItWasOutsideOf) {
  // The lower tip is |x|, |y| <= -z/2: its face towards x is 2x + z = 0, with normal (2, 0, 1)/sqrt(5).
  const Body below(pyramid(-1, 0.5));
  const Body beside(moved(pyramid(1, 0.25), Eigen::AngleAxisd::Identity(), {0.004, 0, 0.001}));
  const Found before = search(beside, below);
  ASSERT_TRUE(before.entrance.has_value());
  ASSERT_EQ(before.contacts.vertices.size(), 1U);
  EXPECT_NEAR(before.contacts.vertices[0].gap, 0.009 / std::sqrt(5.0), 1e-15);
  // Then the upper tip is 0.0004/sqrt(5) below that face, and 0.0002/sqrt(5) below the one towards y.
  const Body above(moved(pyramid(1, 0.25), Eigen::AngleAxisd::Identity(), {0.0003, 0.0004, -0.001}));
  const Found met = search(above, below, before.entrance);
  EXPECT_EQ(met.entrance, before.entrance);
  ASSERT_EQ(met.contacts.vertices.size(), 1U);
  EXPECT_NEAR(met.contacts.vertices[0].gap, -0.0004 / std::sqrt(5.0), 1e-15);
  const Found forgotten = search(above, below);
  ASSERT_EQ(forgotten.contacts.vertices.size(), 1U);
  EXPECT_NEAR(forgotten.contacts.vertices[0].gap, -0.0002 / std::sqrt(5.0), 1e-15);
}

TEST(ConvexSearch, TipsExactlyOnTopOfEachOtherAreHeldApart) {
  const Body below(pyramid(-1, 0.5));
  const Body above(moved(pyramid(1, 0.25), Eigen::AngleAxisd::Identity(), {0, 0, -0.001}));
  for (const bool swapped : {false, true}) {
    const PairContacts contacts = (swapped ? search(below, above) : search(above, below)).contacts;
    EXPECT_EQ(contacts.overlaps.size(), 0U);
    ASSERT_EQ(contacts.vertices.size() + contacts.edges.size(), 1U);
    const double gap = contacts.vertices.empty() ? contacts.edges[0].gap : contacts.vertices[0].gap;
    EXPECT_LT(gap, 0.0);
  }
}

TEST(ConvexSearch, ACornerOnAnEdgeOrACornerGoesInThroughTheFaceItWasOver) {
  // Faces around the edge or corner of the slab that slope to the upper tip's own must not hold it as well.
  const Body on_edge(box({-2, -2, -1}, {0, 2, 0}));
  const Body on_corner(box({-2, -2, -1}, {0, 0, 0}));
  for (const Body* below : {&on_edge, &on_corner}) {
    for (const bool swapped : {false, true}) {
      std::optional<EntranceName> history;
      for (const double height : {0.001, 0.0, -0.0003, -0.0006}) {
        const Body tip(moved(pyramid(1, 0.5), Eigen::AngleAxisd::Identity(), {0, 0, height}));
        const Found found = swapped ? search(tip, *below, history) : search(*below, tip, history);
        history = found.entrance;
        EXPECT_EQ(found.contacts.type,
                  below == &on_edge ? ContactType::vertex_edge : ContactType::vertex_vertex);
        if (height >= 0.0) continue;
        EXPECT_TRUE(found.contacts.edges.empty());
        ASSERT_EQ(found.contacts.vertices.size(), 1U);
        const VertexContact& contact = found.contacts.vertices[0];
        EXPECT_EQ(contact.vertex_of_a, swapped);
        EXPECT_EQ(below->placed.normal(contact.cell), Vector3::UnitZ());
        EXPECT_EQ(contact.gap, height);
      }
    }
  }
}

/// A prism along y.
Polyhedron prism(const std::vector<Eigen::Vector2d>& section, double from, double to) {
  std::vector<Vector3> points;
  for (const double y : {from, to})
    for (const Eigen::Vector2d& corner : section) points.emplace_back(corner.x(), y, corner.y());
  return Polyhedron(make_convex_hull(points));
}

/// A square on its corner, at the origin.
const std::vector<Eigen::Vector2d> standing_square = {{0, 0}, {1, 1}, {0, 2}, {-1, 1}};
/// Roofs with their ridge at the origin, longer towards +x. The slopes of the steep one are those of the
/// standing square.
const std::vector<Eigen::Vector2d> flat_roof = {{0, 0}, {4, -2}, {0, -4}, {-2, -1}};
const std::vector<Eigen::Vector2d> steep_roof = {{0, 0}, {3, -3}, {1, -3}, {-1, -1}};

/// Places along y of contacts at x = z = 0 with gap 0, each once, in order.
std::vector<double> places_along_edge(const PairContacts& contacts, const Body& a, const Body& b) {
  std::vector<double> result;
  const auto add = [&](const Vector3& place, double gap) {
    EXPECT_EQ(gap, 0.0);
    EXPECT_EQ(place.x(), 0.0);
    EXPECT_EQ(place.z(), 0.0);
    result.push_back(place.y());
  };
  for (const VertexContact& contact : contacts.vertices)
    add((contact.vertex_of_a ? a : b).placed.point(contact.point), contact.gap);
  for (const EdgeContact& contact : contacts.edges) {
    const auto& [from, to] = contact.of_a.ends;
    add(a.placed.point(from) + contact.of_a.along * (a.placed.point(to) - a.placed.point(from)), contact.gap);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

struct TouchingEdge {
  Polyhedron below;
  double to;  ///< the edge of a standing square from y = 0 on
  ContactType type;
  std::vector<double> places;  ///< ends of its overlap with the block below
};

TEST(ConvexSearch, AnEdgeThatJustTouchesIsHeldAtBothEnds) {
  const std::vector<TouchingEdge> cases = {
      {box({-4, -1, -1}, {4, 2, 0}), 1, ContactType::edge_face, {0, 1}},
      {box({-4, 0, -1}, {4, 1, 0}), 1, ContactType::edge_face, {0, 1}},
      {box({-4, 1, -1}, {4, 2, 0}), 4, ContactType::edge_face, {1, 2}},
      {box({-2, -1, -1}, {0, 2, 0}), 1, ContactType::edge_edge, {0, 1}},
      {box({-2, 0, -1}, {0, 1, 0}), 1, ContactType::edge_edge, {0, 1}},
      {box({-2, 0.5, -1}, {0, 3, 0}), 1, ContactType::edge_edge, {0.5, 1}},
      {prism(flat_roof, -1, 2), 1, ContactType::edge_edge, {0, 1}},
      {prism(flat_roof, 0, 1), 1, ContactType::edge_edge, {0, 1}},
      {prism(flat_roof, 1, 3), 4, ContactType::edge_edge, {1, 3}},
      {prism(steep_roof, -1, 2), 1, ContactType::edge_edge, {0, 1}},
      {prism(steep_roof, 0, 1), 1, ContactType::edge_edge, {0, 1}},
      {prism(steep_roof, 0.5, 3), 1, ContactType::edge_edge, {0.5, 1}},
      {prism(steep_roof, 1, 3), 4, ContactType::edge_edge, {1, 3}},
  };
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Body above(prism(standing_square, 0, cases[k].to)), below(cases[k].below);
    for (const bool swapped : {false, true}) {
      const Body& a = swapped ? below : above;
      const Body& b = swapped ? above : below;
      const Found found = search(a, b);
      EXPECT_TRUE(found.contacts.overlaps.empty()) << k;
      EXPECT_EQ(found.contacts.type, cases[k].type) << k;
      EXPECT_EQ(places_along_edge(found.contacts, a, b), cases[k].places) << k;
      EXPECT_TRUE(found.entrance.has_value()) << k;
    }
  }
}

TEST(ConvexSearch, AnEdgeThatJustTouchesARidgeOfItsOwnSlopesIsHeldByTheHulls) {
  // No corner of one is over a face of the other and no edges cross. Both faces of the roof are as near; the
  // one towards -x faces what is above, as the mean of the roof's corners is beside the ridge, towards +x.
  const Body above(prism(standing_square, 0, 1)), below(prism(steep_roof, -1, 2));
  EXPECT_TRUE(find_contacts(above.placed, below.placed, limits).empty());
  for (const bool swapped : {false, true}) {
    const Found found = swapped ? search(below, above) : search(above, below);
    EXPECT_TRUE(found.contacts.vertices.empty());
    ASSERT_EQ(found.contacts.edges.size(), 2U);
    const Vector3 out_of_roof = Vector3(-1, 0, 1) / std::sqrt(2.0);
    for (const EdgeContact& contact : found.contacts.edges)
      EXPECT_LT((contact.normal - (swapped ? -1.0 : 1.0) * out_of_roof).norm(), 1e-15);
  }
}

TEST(ConvexSearch, DiagonalNeighboursBearWhenTheyAreDeeperThanRounding) {
  const Body low(box({-1, 0, -1}, {0, 1, 0}));
  const double rounding = 1e-15;
  for (const double x : {-1e-16, 0.0, 1e-16}) {
    for (const double z : {-1e-16, 0.0, 1e-16}) {
      const Body high(moved(box({0, 0, 0}, {1, 1, 1}), Eigen::AngleAxisd::Identity(), {x, 0, z}));
      PairContacts contacts;
      const ConvexSurface of_high(high.placed), of_low(low.placed);
      EXPECT_FALSE(settle_convex_contacts(of_high, of_low, {{}, 0.001, rounding}, contacts).has_value());
      EXPECT_TRUE(contacts.empty()) << x << " " << z;
      // Their earlier history is kept.
      const EntranceName known{EntranceKind::face_of_b, {-1, -1}, {of_low.cell_of_facet(0), -1}, false};
      EXPECT_EQ(settle_convex_contacts(of_high, of_low, {known, 0.001, rounding}, contacts), known);
    }
  }
  // The shortest way out is up.
  const Body inside(box({-3e-6, 0, -2e-6}, {1, 1, 1}));
  PairContacts contacts;
  const auto entrance = settle_convex_contacts(ConvexSurface(inside.placed), ConvexSurface(low.placed),
                                               {{}, 0.001, rounding}, contacts);
  ASSERT_TRUE(entrance.has_value());
  EXPECT_FALSE(contacts.empty());
  const Vector3 out_of_low = entrance->kind == EntranceKind::face_of_a
                                 ? Vector3(-inside.placed.normal(entrance->a[0]))
                                 : low.placed.normal(entrance->b[0]);
  EXPECT_EQ(out_of_low, Vector3::UnitZ());
}

TEST(ConvexSearch, DirectionsOutlastTheRoundingOfATurn) {
  std::mt19937_64 random(20261121);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
  for (int round = 0; round < 200; ++round) {
    // A tip beside an edge of a box whose faces of nine squares are bent by the rounding of a turn.
    const Eigen::AngleAxisd turn(3.0 * number(), Vector3(number(), number(), number() + 1.5).normalized());
    const Vector3 shift = 10.0 * Vector3(number(), number(), number());
    const Polyhedron block = divided_box({-2, -2, -2}, {2, 2, 0});
    const Body base(moved(block, turn, shift));
    const auto tip_at = [&](const Vector3& place) {
      return moved(moved(pyramid(1, 0.25), Eigen::AngleAxisd::Identity(), place), turn, shift);
    };
    const Body above(tip_at({1.9999, 0.3, 0.0005}));
    const Found before = search(above, base);
    ASSERT_TRUE(before.entrance.has_value());
    // 0.0004 below the top, 0.0001 inside of the side.
    const Body inside(tip_at({1.9999, 0.3, -0.0004}));
    const Found met = search(inside, base, before.entrance);
    EXPECT_EQ(met.entrance, before.entrance);
    ASSERT_EQ(met.contacts.vertices.size(), 1U);
    EXPECT_NEAR(met.contacts.vertices[0].gap, -0.0004, 1e-13);
  }
}

TEST(ConvexSearch, TypeIsThatOfTheReportAndNoCrossingIsWithoutContact) {
  std::mt19937_64 random(7);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
  int crossing = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<Vector3> points_a, points_b;
    for (int k = 0; k < 10; ++k) points_a.emplace_back(number(), number(), number());
    for (int k = 0; k < 10; ++k) points_b.emplace_back(number(), number(), number());
    const Polyhedron hull_a(make_convex_hull(points_a)), hull_b(make_convex_hull(points_b));
    // Moved beyond touching along the direction of their closest points.
    const ConvexContact start =
        classify(ConvexShape::from_polyhedron(hull_a),
                 ConvexShape::from_polyhedron(moved(hull_b, Eigen::AngleAxisd::Identity(), {5, 0, 0})));
    const Vector3 nearer = Vector3(5, 0, 0) + start.displacement + 0.001 * start.normal;
    const Body a(hull_a), b(moved(hull_b, Eigen::AngleAxisd::Identity(), nearer));
    const Found found = search(a, b);
    const ContactReport report = report_contact(ReportedSolid(a.solid), ReportedSolid(b.solid));
    if (report.relation == Relation::crossing) {
      ++crossing;
      EXPECT_FALSE(found.contacts.empty()) << "round " << round;
    } else if (found.contacts.type) {
      EXPECT_EQ(found.contacts.type, report.convex->type);
    }
  }
  EXPECT_GT(crossing, 150);
}

}  // namespace
}  // namespace ashlar::convex_search_test

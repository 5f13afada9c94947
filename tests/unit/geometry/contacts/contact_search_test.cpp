#include "geometry/contacts/contact_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/placed_bodies.hpp"
#include "support/sample_solids.hpp"

namespace ashlar::contact_search_test {
namespace {

const ContactLimits limits{0.02, 0.02, 10.0 * std::numbers::pi / 180.0};

using Body = test_support::PlacedBody;
using test_support::box;

Polyhedron moved(const Polyhedron& solid, const Eigen::AngleAxisd& turn, const Vector3& shift) {
  std::vector<Vector3> points;
  for (const Vector3& point : solid.mesh().points) points.emplace_back(turn * point + shift);
  return solid.with_points(std::move(points));
}

double overlap_area(const PairContacts& contacts) {
  double sum = 0.0;
  for (const CellOverlap& overlap : contacts.overlaps) {
    for (std::size_t k = 0; k < overlap.corners.size(); ++k) {
      const auto& p = overlap.corners[k].place;
      const auto& q = overlap.corners[(k + 1) % overlap.corners.size()].place;
      sum += 0.5 * (p.x() * q.y() - p.y() * q.x());
    }
  }
  return sum;
}

TEST(ContactSearch, FaceOnFaceIsTheOverlapAlone) {
  const Body base(box({0, 0, 0}, {4, 4, 1}));
  for (const double gap : {0.01, 0.0, -0.01}) {
    const Body cube(box({3.5, 1, 1 + gap}, {4.5, 2, 2 + gap}));
    for (const bool swapped : {false, true}) {
      const PairContacts contacts = swapped ? find_contacts(base.placed, cube.placed, limits)
                                            : find_contacts(cube.placed, base.placed, limits);
      ASSERT_EQ(contacts.overlaps.size(), 1U);
      EXPECT_TRUE(contacts.vertices.empty());
      EXPECT_TRUE(contacts.edges.empty());
      EXPECT_NEAR(overlap_area(contacts), 0.5, 1e-15);
      for (const double g : contacts.overlaps[0].gaps) EXPECT_NEAR(g, gap, 1e-15);
      EXPECT_EQ(contacts.overlaps[0].frame.w, Vector3(0, 0, swapped ? -1 : 1));
    }
  }
  const Body far(box({3.5, 1, 1.03}, {4.5, 2, 2}));
  EXPECT_TRUE(find_contacts(far.placed, base.placed, limits).empty());
}

TEST(ContactSearch, FarSidesOfThinPlatesDoNotMeet) {
  // In touch at z = 0. Their outer faces look at each other through both, 0.03 deep.
  const Body below(box({0, 0, -0.01}, {2, 1, 0}));
  const Body above(box({0, 0, 0}, {2, 1, 0.02}));
  ContactLimits deep{0.02, 0.1, 0.1};  // as of plates that bend a lot
  EXPECT_EQ(find_contacts(above.placed, below.placed, deep).overlaps.size(), 2U);
  deep.deepest = 0.015;
  const PairContacts contacts = find_contacts(above.placed, below.placed, deep);
  ASSERT_EQ(contacts.overlaps.size(), 1U);
  for (const double gap : contacts.overlaps[0].gaps) EXPECT_EQ(gap, 0.0);
  EXPECT_TRUE(contacts.vertices.empty());
  EXPECT_TRUE(contacts.edges.empty());
}

TEST(ContactSearch, AreaDoesNotDependOnTheDivisionOfTheFaces) {
  const Body plain(box({0, 0, 0}, {4, 4, 1}));
  const Body cube(
      moved(box({-0.5, -0.5, 0}, {0.5, 0.5, 1}), Eigen::AngleAxisd(0.3, Vector3::UnitZ()), {2, 2, 1}));
  const Body divided(box({0, 0, 0}, {4, 4, 1}), 3);
  EXPECT_NEAR(overlap_area(find_contacts(cube.placed, plain.placed, limits)), 1.0, 1e-14);
  const PairContacts contacts = find_contacts(cube.placed, divided.placed, limits);
  EXPECT_GT(contacts.overlaps.size(), 4U);
  EXPECT_NEAR(overlap_area(contacts), 1.0, 1e-14);
  EXPECT_TRUE(contacts.vertices.empty());  // inner points of a divided face are no vertices
  EXPECT_TRUE(contacts.edges.empty());
}

TEST(ContactSearch, CubeOnItsEdge) {
  // Turned by 45 degrees about y: the lowest edge runs along y at z = 1.
  const double r = std::sqrt(0.5);
  const Body base(box({-4, -4, 0}, {4, 4, 1}));
  const Body cube(moved(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}),
                        Eigen::AngleAxisd(std::numbers::pi / 4, Vector3::UnitY()), {0, 0, 1 + r - 0.005}));
  const PairContacts contacts = find_contacts(cube.placed, base.placed, limits);
  EXPECT_TRUE(contacts.overlaps.empty());
  EXPECT_TRUE(contacts.edges.empty());
  ASSERT_EQ(contacts.vertices.size(), 2U);  // both ends of the edge
  for (const VertexContact& contact : contacts.vertices) {
    EXPECT_TRUE(contact.vertex_of_a);
    EXPECT_NEAR(contact.gap, -0.005, 1e-14);
    EXPECT_NEAR(contact.area, 0.25, 1e-14);
  }
}

TEST(ContactSearch, EdgeOverARimEndsInACrossing) {
  const double r = std::sqrt(0.5);
  const Body base(box({-4, 0, 0}, {4, 4, 1}));
  const Body cube(moved(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}),
                        Eigen::AngleAxisd(std::numbers::pi / 4, Vector3::UnitY()), {0, 0, 1 + r + 0.005}));
  const PairContacts contacts = find_contacts(cube.placed, base.placed, limits);
  ASSERT_EQ(contacts.vertices.size(), 1U);
  ASSERT_EQ(contacts.edges.size(), 1U);
  EXPECT_NEAR(contacts.edges[0].gap, 0.005, 1e-14);
  EXPECT_LT((contacts.edges[0].normal - Vector3::UnitZ()).norm(), 1e-14);
}

TEST(ContactSearch, CrossedEdges) {
  // Two ridges at right angles, one from above.
  const double r = std::sqrt(0.5);
  const Eigen::AngleAxisd about_y(std::numbers::pi / 4, Vector3::UnitY());
  const Eigen::AngleAxisd about_x(std::numbers::pi / 4, Vector3::UnitX());
  const Body below(moved(box({-0.5, -2, -0.5}, {0.5, 2, 0.5}), about_y, {0, 0, 0}));
  const Body above(moved(box({-2, -0.5, -0.5}, {2, 0.5, 0.5}), about_x, {0, 0, 2 * r - 0.01}));
  const PairContacts contacts = find_contacts(above.placed, below.placed, limits);
  EXPECT_TRUE(contacts.overlaps.empty());
  EXPECT_TRUE(contacts.vertices.empty());
  ASSERT_EQ(contacts.edges.size(), 1U);
  EXPECT_NEAR(contacts.edges[0].gap, -0.01, 1e-14);
  EXPECT_NEAR(contacts.edges[0].of_a.along, 0.5, 1e-14);
  EXPECT_LT((contacts.edges[0].normal - Vector3::UnitZ()).norm(), 1e-14);
}

TEST(ContactSearch, CubeOnItsCorner) {
  const Eigen::Quaterniond upright =
      Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1).normalized(), Vector3(0, 0, -1));
  const Body base(box({-4, -4, 0}, {4, 4, 1}));
  const Body cube(moved(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), Eigen::AngleAxisd(upright),
                        {0, 0, 1 + 0.5 * std::sqrt(3.0) - 0.001}));
  const PairContacts contacts = find_contacts(cube.placed, base.placed, limits);
  ASSERT_EQ(contacts.vertices.size(), 1U);
  EXPECT_NEAR(contacts.vertices[0].gap, -0.001, 1e-14);
  EXPECT_TRUE(contacts.overlaps.empty() && contacts.edges.empty());
}

TEST(ContactSearch, VertexOverARidgeEntersThroughOneFace) {
  const Body ridge(moved(box({-0.5, -2, -0.5}, {0.5, 2, 0.5}),
                         Eigen::AngleAxisd(std::numbers::pi / 4, Vector3::UnitY()), {0, 0, -std::sqrt(0.5)}));
  const Eigen::Quaterniond upright =
      Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1).normalized(), Vector3(0, 0, -1));
  const Body cube(moved(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), Eigen::AngleAxisd(upright),
                        {0, 0.1, 0.5 * std::sqrt(3.0) - 0.001}));
  const PairContacts contacts = find_contacts(cube.placed, ridge.placed, limits);
  EXPECT_LE(contacts.vertices.size(), 1U);
}

TEST(ContactSearch, ABlockInACornerHasTwoContacts) {
  const Body corner(test_support::l_shaped_prism());  // notch at x > 1, y > 1
  const Body cube(box({1, 1, 0}, {2, 2, 1}));
  const PairContacts contacts = find_contacts(cube.placed, corner.placed, limits);
  EXPECT_NEAR(overlap_area(contacts), 2.0, 1e-14);
  for (const CellOverlap& overlap : contacts.overlaps) {
    EXPECT_NEAR(std::abs(overlap.frame.w.x()) + std::abs(overlap.frame.w.y()), 1.0, 1e-15);
  }
  EXPECT_TRUE(contacts.vertices.empty());
  EXPECT_TRUE(contacts.edges.empty());
}

TEST(ContactSearch, MeetingBoxesEqualBruteForce) {
  std::mt19937_64 random(20241107);
  const auto number = [&] { return static_cast<double>(random() % 1000) / 100.0; };
  std::vector<Box> boxes;
  for (int k = 0; k < 300; ++k) {
    const Vector3 low(number(), number(), number());
    boxes.push_back({low, low + 0.1 * Vector3(number(), number(), number())});
  }
  std::vector<std::array<int, 2>> expected;
  for (int i = 0; i < 300; ++i) {
    for (int j = i + 1; j < 300; ++j) {
      if (boxes[static_cast<std::size_t>(i)].meets(boxes[static_cast<std::size_t>(j)]))
        expected.push_back({i, j});
    }
  }
  EXPECT_GT(expected.size(), 30U);
  EXPECT_EQ(meeting_boxes(boxes), expected);
  EXPECT_TRUE(meeting_boxes({}).empty());
}

TEST(SubFaceSurface, DividesConformingly) {
  for (const int levels : {-1, 0, 1, 2}) {
    const Body body(test_support::l_shaped_prism(), levels);
    double area = 0.0;
    for (std::size_t c = 0; c < body.surface.cells.size(); ++c) {
      const auto corners = body.placed.corners(static_cast<int>(c));
      Vector3 sum = Vector3::Zero();
      for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        sum += 0.5 * (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
      }
      area += sum.norm();
    }
    EXPECT_NEAR(area, 2 * 3.0 + 8.0, 1e-13);
    double edge_length = 0.0;
    for (const SurfaceEdge& edge : body.surface.edges) {
      edge_length += (body.placed.point(edge.ends[1]) - body.placed.point(edge.ends[0])).norm();
    }
    EXPECT_NEAR(edge_length, 2 * 8.0 + 6.0, 1e-13);
  }
  EXPECT_EQ(divide_surface(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), 2).cells.size(), 12U * 16U);
  EXPECT_THROW((void)divide_surface(Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), 9), std::invalid_argument);
}

/// Ground with a V groove along y, from -1 to 1, flanks at 45 degrees: the valley's line is x = z = 0.
Polyhedron groove() {
  const std::vector<std::array<double, 2>> outline = {{0, 0}, {-2, 2}, {-2, -1}, {2, -1}, {2, 2}};
  TriangleMesh mesh;
  for (const double y : {-1.0, 1.0})
    for (const auto& [x, z] : outline) mesh.points.emplace_back(x, y, z);
  for (int k = 1; k < 4; ++k) {
    mesh.triangles.push_back({0, k, k + 1});
    mesh.triangles.push_back({5, 5 + k + 1, 5 + k});
  }
  for (int k = 0; k < 5; ++k) {
    const int next = (k + 1) % 5;
    mesh.triangles.push_back({k, 5 + k, next});
    mesh.triangles.push_back({next, 5 + k, 5 + next});
  }
  return Polyhedron(std::move(mesh));
}

/// A tip that points down, with steep sides.
Polyhedron tip(const Vector3& at) {
  return Polyhedron(make_convex_hull(std::vector<Vector3>{
      at, at + Vector3(0.3, 0.1, 1), at + Vector3(-0.2, 0.3, 1), at + Vector3(-0.1, -0.3, 1)}));
}

TEST(ContactSearch, ATipBelowAValleyIsHeldByBothFlanks) {
  const Body ground(groove());
  // Below the valley's line the foot on either flank lies beyond it.
  for (const auto& [x, z] : {std::pair{0.0, -0.01}, {0.004, -0.01}, {-0.006, -0.008}}) {
    const Body falling(tip({x, 0.1, z}));
    for (const bool swapped : {false, true}) {
      const PairContacts contacts = swapped ? find_contacts(ground.placed, falling.placed, limits)
                                            : find_contacts(falling.placed, ground.placed, limits);
      ASSERT_EQ(contacts.vertices.size(), 2U);
      std::vector<double> gaps = {contacts.vertices[0].gap, contacts.vertices[1].gap};
      std::sort(gaps.begin(), gaps.end());
      // Flanks z = x and z = -x.
      EXPECT_NEAR(gaps[0], (z - std::abs(x)) / std::sqrt(2.0), 1e-15);
      EXPECT_NEAR(gaps[1], (z + std::abs(x)) / std::sqrt(2.0), 1e-15);
    }
  }
}

TEST(ContactSearch, AFlankEndsAtItsConvexRim) {
  // The outer rim of a flank is x = z = 2: points below the flank's plane beyond it are beside the block.
  const Body ground(groove());
  const Body beside(tip({2.004, 0.1, 1.99}));
  for (const VertexContact& contact : find_contacts(beside.placed, ground.placed, limits).vertices) {
    EXPECT_FALSE(contact.vertex_of_a &&
                 std::abs(ground.placed.normal(contact.cell).z() - std::sqrt(0.5)) < 0.1);
  }
}

TEST(ContactSearch, AnEdgeThatIsLongerThanAValleyIsHeldByBothOfItsRims) {
  const Body ground(groove());
  constexpr double depth = 0.01;
  std::vector<Vector3> points;
  for (const double y : {-3.0, 3.0})
    for (const auto& [x, z] : {std::pair{0.0, 0.0}, {0.1, 0.5}, {-0.1, 0.5}})
      points.emplace_back(x, y, z - depth);
  const Body beam(Polyhedron(make_convex_hull(points)));
  const PairContacts contacts = find_contacts(beam.placed, ground.placed, limits);
  // At each end of the valley one crossing with each of the two rims that meet there, beyond the end of both.
  ASSERT_EQ(contacts.edges.size(), 4U);
  for (const EdgeContact& contact : contacts.edges) {
    EXPECT_NEAR(contact.gap, -depth / std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(std::abs(contact.normal.x()), 1.0 / std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(contact.normal.z(), 1.0 / std::sqrt(2.0), 1e-15);
  }
}

TEST(ContactSearch, BehindAHiddenSideTheFaceBesideItHolds) {
  // The right half of the groove as a separate block: its side x = 0 lies on the left half.
  const Body half(Polyhedron(make_convex_hull(std::vector<Vector3>{
      {0, -1, 0}, {2, -1, 2}, {2, -1, -1}, {0, -1, -1}, {0, 1, 0}, {2, 1, 2}, {2, 1, -1}, {0, 1, -1}})));
  // 1 mm behind the side, 8 mm below the flank: the side is nearer, but it is occluded.
  const Vector3 place(0.001, 0.1, 0.001 - 0.008 * std::sqrt(2.0));
  const Body falling(Polyhedron(make_convex_hull(std::vector<Vector3>{
      place, place + Vector3(-0.1, 0.1, 1), place + Vector3(-0.4, 0.3, 1), place + Vector3(-0.2, -0.3, 1)})));
  const auto nothing = [](int, const Vector3&) { return false; };
  const auto side = [&](int face, const Vector3&) {
    return half.solid.faces()[static_cast<std::size_t>(face)].normal.x() < -0.9;
  };
  const PairContacts open = find_contacts(falling.placed, half.placed, limits);
  ASSERT_EQ(open.vertices.size(), 1U);
  EXPECT_NEAR(open.vertices[0].gap, -0.001, 1e-15);
  const OccludedPlaces hidden{nothing, side};
  const PairContacts behind = find_contacts(falling.placed, half.placed, limits, &hidden);
  ASSERT_EQ(behind.vertices.size(), 1U);
  EXPECT_NEAR(behind.vertices[0].gap, -0.008, 1e-15);
}

TEST(ContactSearch, TheAreaOfACornerDoesNotDependOnTheTrianglesOfItsFaces) {
  // Faces of 2, 3 and 6 m^2, a quarter of each at each of its corners; some corners are on a diagonal.
  const Body body(box({0, 0, 0}, {1, 2, 3}), 0);
  ASSERT_EQ(body.surface.vertices.size(), 8U);
  for (const SurfaceVertex& vertex : body.surface.vertices)
    EXPECT_DOUBLE_EQ(tributary_area(body.surface, vertex.cells), (0.5 + 0.75 + 1.5) / 3.0);
}

}  // namespace
}  // namespace ashlar::contact_search_test

// Plates of any outline on each other: the contact points of their face-face contact are the vertices of the
// overlap polygon that brute force finds, for every triangulation; and convex solids have the one contact of
// the convex classifier.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "geometry/contacts/contact_report.hpp"
#include "geometry/contacts/solid_contacts.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"
#include "oracle/flat_overlap.hpp"

namespace ashlar::solid_contacts_against_oracle_test {
namespace {

using Random = std::mt19937_64;

int pick(Random& random, int count) {
  return static_cast<int>(random() % static_cast<std::uint64_t>(count));
}

// A plane region of whole coordinates.
struct Profile {
  std::vector<std::array<int, 2>> points;
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise

  int add(int x, int y) {
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points[k] == std::array{x, y}) return static_cast<int>(k);
    points.push_back({x, y});
    return static_cast<int>(points.size()) - 1;
  }
};

// Halves of the squares of a grid that belong to the solid, independent of its triangulation.
struct Cells {
  static constexpr int size = 5;
  std::array<std::array<int, size>, size> kind{};  // 0 none, 1 whole, 2 to 5 one of the four halves
};

Cells random_cells(Random& random) {
  Cells cells;
  for (auto& row : cells.kind)
    for (int& kind : row) {
      const int dice = pick(random, 10);
      kind = dice < 3 ? 0 : dice < 8 ? 1 : 2 + pick(random, 4);
    }
  return cells;
}

// Spacing 6 leaves room for the middle of a triangle on whole coordinates.
Profile triangulate(const Cells& cells, Random& random) {
  constexpr int spacing = 6;
  Profile profile;
  const auto add = [&](const std::array<int, 3>& t) {
    const auto [a, b, c] = t;
    if (pick(random, 3) > 0) {
      profile.triangles.push_back(t);
      return;
    }
    const auto& p = profile.points;
    const int m = profile.add((p[a][0] + p[b][0] + p[c][0]) / 3, (p[a][1] + p[b][1] + p[c][1]) / 3);
    for (const auto& part : {std::array{a, b, m}, std::array{b, c, m}, std::array{c, a, m}})
      profile.triangles.push_back(part);
  };
  for (int i = 0; i < Cells::size; ++i)
    for (int k = 0; k < Cells::size; ++k) {
      const int kind = cells.kind[i][k];
      if (kind == 0) continue;
      const int x = i * spacing, y = k * spacing;
      const std::array<std::array<int, 2>, 4> corners{
          {{x, y}, {x + spacing, y}, {x + spacing, y + spacing}, {x, y + spacing}}};
      const auto corner = [&](int c) { return profile.add(corners[c % 4][0], corners[c % 4][1]); };
      // One half is left out of some squares; the others have either diagonal.
      const int first = kind > 1 ? kind - 1 : pick(random, 2);
      add({corner(first), corner(first + 1), corner(first + 2)});
      if (kind == 1) add({corner(first), corner(first + 2), corner(first + 3)});
    }
  return profile;
}

// Prism over a profile between two heights, sides of the outline divided now and then.
TriangleMesh extrude(const Profile& profile, double low, double high) {
  const int n = static_cast<int>(profile.points.size());
  TriangleMesh mesh;
  for (const double z : {low, high})
    for (const auto& [x, y] : profile.points) mesh.points.emplace_back(x, y, z);
  std::set<std::array<int, 2>> sides;
  for (const auto& [a, b, c] : profile.triangles)
    for (const auto& side : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      if (sides.erase({side[1], side[0]}) == 0) sides.insert(side);
  for (const auto& [a, b, c] : profile.triangles) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + n, b + n, c + n});
  }
  for (const auto& [a, b] : sides) {
    mesh.triangles.push_back({a, b, b + n});
    mesh.triangles.push_back({a, b + n, a + n});
  }
  return mesh;
}

// One piece over sides of triangles, and no point where the outline meets itself.
bool is_solid(const Cells& cells) {
  Random random(1);
  const Profile profile = triangulate(cells, random);
  std::map<std::array<int, 2>, int> triangle_of;
  for (int t = 0; t < static_cast<int>(profile.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) triangle_of[{profile.triangles[t][k], profile.triangles[t][(k + 1) % 3]}] = t;
  std::vector<int> leaving(profile.points.size(), 0);
  std::vector<std::vector<int>> neighbours(profile.triangles.size());
  for (const auto& [side, t] : triangle_of) {
    const auto twin = triangle_of.find({side[1], side[0]});
    if (twin != triangle_of.end())
      neighbours[t].push_back(twin->second);
    else if (++leaving[side[0]] > 1)
      return false;
  }
  if (neighbours.empty()) return false;
  std::set<int> reached{0};
  std::vector<int> open{0};
  while (!open.empty()) {
    const int t = open.back();
    open.pop_back();
    for (const int next : neighbours[t])
      if (reached.insert(next).second) open.push_back(next);
  }
  return reached.size() == neighbours.size();
}

// Whole numbers: |q|^2 times a rotation.
Eigen::Matrix3d whole_rotation(Random& random, double& scale) {
  Eigen::Vector4d q;
  do {
    for (double& x : q) x = static_cast<double>(pick(random, 7) - 3);
  } while (q.isZero());
  scale = q.squaredNorm();
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Eigen::Matrix3d m;
  m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return m;
}

TriangleMesh moved(TriangleMesh mesh, const Eigen::Matrix3d& m) {
  for (Vector3& p : mesh.points) p = m * p;
  return mesh;
}

oracle::PlaneRegion region_of(const Profile& profile) {
  oracle::PlaneRegion region;
  for (const auto& t : profile.triangles) {
    auto& triangle = region.emplace_back();
    for (int k = 0; k < 3; ++k) triangle[k] = {profile.points[t[k]][0], profile.points[t[k]][1]};
  }
  return region;
}

// Shears and turns of the plane by whole numbers, so that outlines cross at all angles.
Profile transformed(Profile profile, const std::array<int, 6>& m) {
  for (auto& [x, y] : profile.points) {
    const int u = m[0] * x + m[1] * y + m[4], v = m[2] * x + m[3] * y + m[5];
    x = u;
    y = v;
  }
  return profile;
}

std::array<int, 6> random_map(Random& random) {
  constexpr std::array<std::array<int, 4>, 5> maps{
      {{1, 0, 0, 1}, {0, -1, 1, 0}, {1, -1, 1, 1}, {2, 1, -1, 1}, {1, 1, 0, 1}}};
  const auto& m = maps[pick(random, 5)];
  return {m[0], m[1], m[2], m[3], pick(random, 31) - 15, pick(random, 31) - 15};
}

double numerator_over(const mpq_class& value) {
  // Denominators are below 2^20 and values below 2^30, so that the quotient of two doubles is rounded once.
  return value.get_num().get_d() / value.get_den().get_d();
}

std::vector<Vector3> sorted(std::vector<Vector3> points) {
  std::sort(points.begin(), points.end(), [](const Vector3& p, const Vector3& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  });
  return points;
}

// The points on one body, whichever of the two the point and its foot are on.
std::vector<Vector3> points_on(const ReportedContact& contact, ReportedBody body) {
  std::vector<Vector3> points;
  for (const ReportedPoint& p : contact.points) {
    const bool point_is_on_a = p.face_of != ReportedBody::a;
    points.push_back(point_is_on_a == (body == ReportedBody::a) ? p.point : p.foot);
  }
  return sorted(points);
}

class Plates : public ::testing::TestWithParam<int> {};

TEST_P(Plates, ContactPointsAreTheVerticesOfTheOverlap) {
  Random random(static_cast<std::uint64_t>(71 + GetParam()));
  const int gap = GetParam() % 3;
  int overlapping = 0, isolated = 0;
  for (int round = 0; round < 40; ++round) {
    Cells cells_a, cells_b;
    do cells_a = random_cells(random);
    while (!is_solid(cells_a));
    do cells_b = random_cells(random);
    while (!is_solid(cells_b));
    const std::array<int, 6> map_a = random_map(random), map_b = random_map(random);
    double scale = 1.0;
    const Eigen::Matrix3d rotation = whole_rotation(random, scale);
    const oracle::FlatOverlap expected(region_of(transformed(triangulate(cells_a, random), map_a)),
                                       region_of(transformed(triangulate(cells_b, random), map_b)));
    std::vector<Vector3> lower, upper;
    for (const oracle::PlanePoint& p : expected.vertices()) {
      // z is 1 and 1 + gap; the sum over three terms has one denominator.
      Vector3 place[2];
      for (int i = 0; i < 3; ++i) {
        const mpq_class flat(p.x * mpq_class(rotation(i, 0)) + p.y * mpq_class(rotation(i, 1)));
        for (int k = 0; k < 2; ++k)
          place[k][i] = numerator_over(mpq_class(flat + (1 + k * gap) * mpq_class(rotation(i, 2))));
      }
      lower.push_back(place[0]);
      upper.push_back(place[1]);
    }
    for (int again = 0; again < 3; ++again) {
      const Polyhedron a(moved(extrude(transformed(triangulate(cells_a, random), map_a), 0, 1), rotation)),
          b(moved(extrude(transformed(triangulate(cells_b, random), map_b), 1.0 + gap, 2.0 + gap), rotation));
      const ContactReport report = report_solids(b, a, scale * gap);
      ASSERT_EQ(report.relation == Relation::touching, report.squared_distance == 0.0);
      const ReportedContact* face_face = nullptr;
      for (const ReportedContact& contact : report.contacts) {
        if (contact.type == ContactType::face_face) {
          ASSERT_EQ(face_face, nullptr);
          face_face = &contact;
          continue;
        }
        ++isolated;
      }
      ASSERT_EQ(face_face != nullptr, !lower.empty()) << round;
      if (face_face == nullptr) continue;
      ++overlapping;
      EXPECT_EQ(points_on(*face_face, ReportedBody::a), sorted(upper)) << round;
      EXPECT_EQ(points_on(*face_face, ReportedBody::b), sorted(lower)) << round;
      EXPECT_EQ(face_face->area, numerator_over(mpq_class(expected.area() * mpq_class(scale * scale))));
      EXPECT_EQ(face_face->squared_distance, scale * scale * gap * gap);
      for (const ReportedPoint& p : face_face->points) EXPECT_EQ(p.gap, scale * gap);
    }
  }
  EXPECT_GT(overlapping, 60);
  EXPECT_GT(isolated, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Plates, ::testing::Range(0, 6));

TriangleMesh lattice_hull(Random& random) {
  for (;;) {
    std::vector<Vector3> points;
    const int count = 4 + pick(random, 5);
    while (static_cast<int>(points.size()) < count)
      points.emplace_back(pick(random, 4), pick(random, 4), pick(random, 4));
    try {
      return make_convex_hull(points);
    } catch (const std::invalid_argument&) {
      // coplanar: other points
    }
  }
}

// A convex solid has one minimum, at any contact distance.
TEST(ConvexSolids, HaveTheContactOfTheConvexClassifier) {
  Random random(5);
  std::map<ContactType, int> seen;
  for (int round = 0; round < 3000; ++round) {
    TriangleMesh mesh = lattice_hull(random);
    const ReportedSolid a{Polyhedron(lattice_hull(random))};
    const Vector3 shift(pick(random, 5), pick(random, 4), pick(random, 2));
    for (Vector3& p : mesh.points) p += shift;
    const ReportedSolid b{Polyhedron(mesh)};
    const ContactReport expected = report_contact(a, b);
    if (expected.relation == Relation::crossing) continue;
    for (const auto& distance : {std::optional<double>(), std::optional<double>(1000.0)}) {
      const ContactReport report = report_solids(a.solid(), b.solid(), distance);
      ASSERT_EQ(report.relation, expected.relation);
      ASSERT_EQ(report.squared_distance, expected.squared_distance);
      ASSERT_EQ(report.contacts.size(), 1u) << round;
      const ReportedContact &found = report.contacts[0], &right = expected.contacts[0];
      ++seen[found.type];
      EXPECT_EQ(found.type, right.type) << round;
      EXPECT_EQ(found.a, right.a) << round;
      EXPECT_EQ(found.b, right.b) << round;
      EXPECT_EQ(found.region_dimension, right.region_dimension) << round;
      for (const ReportedBody body : {ReportedBody::a, ReportedBody::b})
        EXPECT_EQ(points_on(found, body), points_on(right, body)) << round;
      EXPECT_NEAR(found.area, right.area, 1e-13 * right.area) << round;  // that of rounded points
      EXPECT_EQ(found.squared_distance, expected.squared_distance);
      const bool fixed = expected.convex->rule == DirectionRule::closest_points ||
                         expected.convex->rule == DirectionRule::unique;
      EXPECT_EQ(found.direction, fixed ? expected.convex->direction : Vector3(0, 0, 0)) << round;
    }
  }
  EXPECT_EQ(seen.size(), 6u);
}

}  // namespace
}  // namespace ashlar::solid_contacts_against_oracle_test

#include "geometry/solid/self_intersection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <random>
#include <set>

#include "geometry/solid/mesh_defects.hpp"
#include "support/sample_meshes.hpp"

namespace ashlar::self_intersection_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Triangle = std::array<int, 3>;
using IntegerVector = Eigen::Matrix<long long, 3, 1>;
using IntegerTriangle = std::array<IntegerVector, 3>;

// Independent judge in integers: compact convex sets are disjoint if and only if a facet normal of their
// difference separates them, and for triangles those are among the normals, the products of two sides, and,
// for parallel ones, the products of a normal and a side.
bool meet(const IntegerTriangle& a, const IntegerTriangle& b) {
  std::vector<IntegerVector> sides[2];
  for (int k = 0; k < 3; ++k) {
    sides[0].push_back(a[(k + 1) % 3] - a[k]);
    sides[1].push_back(b[(k + 1) % 3] - b[k]);
  }
  std::vector<IntegerVector> axes;
  for (const auto& s : sides) {
    const IntegerVector normal = s[0].cross(s[1]);
    axes.push_back(normal);
    for (const IntegerVector& side : s) axes.push_back(normal.cross(side));
  }
  for (const IntegerVector& u : sides[0]) {
    for (const IntegerVector& v : sides[1]) axes.push_back(u.cross(v));
  }
  for (const IntegerVector& axis : axes) {
    const auto [a_low, a_high] = std::minmax({axis.dot(a[0]), axis.dot(a[1]), axis.dot(a[2])});
    const auto [b_low, b_high] = std::minmax({axis.dot(b[0]), axis.dot(b[1]), axis.dot(b[2])});
    if (a_high < b_low || b_high < a_low) return false;
  }
  return true;
}

TEST(SelfIntersection, agrees_with_integer_separation_on_degenerate_pairs) {
  std::mt19937_64 random(3);
  int meeting = 0;
  int compared = 0;
  while (compared < 20000) {
    std::vector<Vector3> points;
    std::array<IntegerTriangle, 2> triangles;
    std::set<std::array<long long, 3>> distinct;
    for (int i = 0; i < 6; ++i) {
      // Half of the coordinates of the second triangle repeat those of the first: parallel planes, common
      // lines.
      const auto coordinate = [&] { return static_cast<long long>(random() % 4); };
      IntegerVector p(coordinate(), coordinate(), coordinate());
      if (i >= 3 && random() % 2 == 0) p.z() = triangles[0][0].z();
      triangles[i / 3][i % 3] = p;
      points.push_back(p.cast<double>());
      distinct.insert({p.x(), p.y(), p.z()});
    }
    if (distinct.size() < 6 || is_degenerate(points, {0, 1, 2}) || is_degenerate(points, {3, 4, 5})) continue;
    const bool expected = meet(triangles[0], triangles[1]);
    EXPECT_EQ(self_intersections(points, {{0, 1, 2}, {3, 4, 5}}, 9).size(), expected ? 1U : 0U);
    ++compared;
    meeting += expected ? 1 : 0;
  }
  EXPECT_GT(meeting, compared / 10);
  EXPECT_LT(meeting, compared - compared / 10);
}

TEST(SelfIntersection, neighbours_may_share_what_they_name) {
  const std::vector<Vector3> points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0},  {2, 2, 0},
                                    {0, 0, 2}, {1, 1, 0}, {-1, -1, 0}};
  const auto pairs = [&points](const Triangle& a, const Triangle& b) {
    return self_intersections(points, {a, b}, 9);
  };
  EXPECT_THAT(pairs({0, 1, 2}, {1, 3, 2}), IsEmpty());                      // flat, over an edge
  EXPECT_THAT(pairs({0, 1, 2}, {0, 4, 1}), IsEmpty());                      // bent, over an edge
  EXPECT_THAT(pairs({0, 1, 2}, {0, 4, 6}), IsEmpty());                      // in a corner
  EXPECT_THAT(pairs({0, 1, 2}, {0, 1, 3}), ElementsAre(std::array{0, 1}));  // folded on each other
  EXPECT_THAT(pairs({0, 1, 2}, {0, 4, 5}),
              ElementsAre(std::array{0, 1}));  // corner, and the side's end inside
  EXPECT_THAT(pairs({0, 1, 2}, {0, 4, 3}), ElementsAre(std::array{0, 1}));  // corner, and a crossing
  EXPECT_THAT(pairs({0, 1, 2}, {2, 1, 0}), ElementsAre(std::array{0, 1}));  // the same three points
}

bool has_equal_points(const std::vector<Vector3>& points) {
  std::set<std::array<double, 3>> distinct;
  for (const Vector3& p : points) distinct.insert({p.x(), p.y(), p.z()});
  return distinct.size() < points.size();
}

// Moving points of sound meshes on a coarse grid makes both kinds; the quick proof must never pass a bad one.
TEST(SelfIntersection, quick_proof_never_contradicts_the_search) {
  std::mt19937_64 random(5);
  int proved = 0;
  int refuted = 0;
  for (int round = 0; round < 3000; ++round) {
    TriangleMesh mesh = round % 2 == 0 ? make_sphere({0, 0, 0}, 4.0, 1) : test_support::make_divided_cube(2);
    for (Vector3& p : mesh.points) p = (round % 2 == 0 ? p : Vector3(8.0 * p)).array().round();
    for (int i = 0; i < 3; ++i) {
      Vector3& p = mesh.points[random() % mesh.points.size()];
      p += Vector3(random() % 5, random() % 5, random() % 5) - Vector3::Constant(2.0);
    }
    bool sound = !has_equal_points(mesh.points);
    for (const Triangle& t : mesh.triangles) sound = sound && !is_degenerate(mesh.points, t);
    sound = sound && self_intersections(mesh.points, mesh.triangles, 1).empty();
    const bool quick = is_star_shaped(mesh);
    EXPECT_TRUE(sound || !quick);
    proved += quick ? 1 : 0;
    refuted += sound ? 0 : 1;
  }
  EXPECT_GT(proved, 100);
  EXPECT_GT(refuted, 100);
}

TEST(SelfIntersection, number_of_pairs_is_limited) {
  std::vector<Vector3> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < 50; ++i) {
    points.insert(points.end(), {{0.0, 0.0, i * 0.0}, {1.0 + i, 0, 0}, {0, 1.0 + i, 0}});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_EQ(self_intersections(points, triangles, 7).size(), 7U);
  EXPECT_EQ(self_intersections(points, triangles, 10000).size(), 50U * 49U / 2U);
  // All of these meet, so that as many are found as are tested.
  EXPECT_EQ(self_intersections(points, triangles, 10000, 12).size(), 12U);
  EXPECT_EQ(self_intersections(points, triangles, 7, 12).size(), 7U);
}

}  // namespace
}  // namespace ashlar::self_intersection_test

#include "mechanics/contact/contact_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <utility>

#include "geometry/index.hpp"
#include "support/simulations.hpp"

namespace ashlar::contact_points_test {
namespace {

using test_support::block_of;

/// A block that has moved as a rigid body.
struct MovedBody {
  BlockModel model;
  BlockState state;
  SubFaceSurface surface = whole_surface(model.solid());
  PlacedSurface placed;

  MovedBody(Polyhedron solid, const Eigen::Isometry3d& motion)
      : model(block_of("block", std::move(solid), {2500, 1e9, 0.2}, 1)),
        state(model.initial_state()),
        placed(surface, moved(surface.points, motion)) {
    state.position = model.basis().linear_field(motion * model.basis().centroid(), motion.linear());
  }
  MovedBody(const MovedBody&) = delete;
  MovedBody& operator=(const MovedBody&) = delete;
  [[nodiscard]] ContactBody contact() const { return {&model, &state, &placed}; }
  static std::vector<Vector3> moved(std::vector<Vector3> points, const Eigen::Isometry3d& motion) {
    for (Vector3& point : points) point = motion * point;
    return points;
  }
};

std::vector<ContactPoint> points_of(const MovedBody& a, const MovedBody& b, double known, bool curved,
                                    bool a_is_master) {
  const ContactLimits limits{0.1, 0.1, 10.0 * std::numbers::pi / 180.0};
  const PairContacts found = find_contacts(a.placed, b.placed, limits);
  ContactPointSettings settings;
  settings.curved = curved;
  settings.known_overlap = known;
  return contact_points(a.contact(), b.contact(), found,
                        std::vector<bool>(found.overlaps.size(), a_is_master), settings, {})
      .points;
}

constexpr double depth = 1e-4;

// A cube placed 1e-4 m deep in a slab; both have turned together, far, and the cube has slid along the slab and
// gone 1e-5 m deeper since. Its gaps count from where it was placed.
TEST(ContactPoints, CountGapsFromWhereBlocksWerePlacedWhereverTheyAre) {
  Eigen::Isometry3d turned(Eigen::AngleAxisd(2.2, Vector3(1, 2, -1).normalized()));
  turned.pretranslate(Vector3(3, -2, 5));
  for (const double deeper : {0.0, 1e-5, -1e-5}) {
    const Eigen::Isometry3d slid = turned * Eigen::Translation3d(0.3, 0.2, -deeper);
    const MovedBody cube(Polyhedron(make_box({0, 0, -depth}, {1, 1, 1})), slid);
    const MovedBody slab(Polyhedron(make_box({-2, -2, -1}, {3, 3, 0})), turned);
    for (const bool curved : {false, true}) {
      for (const bool first : {false, true}) {
        const MovedBody& a = first ? cube : slab;
        const MovedBody& b = first ? slab : cube;
        for (const bool a_is_master : {false, true}) {
          const auto points = points_of(a, b, 2.0 * depth, curved, a_is_master);
          ASSERT_FALSE(points.empty());
          for (const ContactPoint& point : points) {
            EXPECT_NEAR(point.overlap, depth, 1e-15);
            EXPECT_NEAR(point.gap, -deeper, 1e-14);
          }
        }
        for (const ContactPoint& point : points_of(a, b, 0.0, curved, false)) {
          EXPECT_EQ(point.overlap, 0.0);
          EXPECT_NEAR(point.gap, -depth - deeper, 1e-14);
        }
        // No more than is known of the pair.
        for (const ContactPoint& point : points_of(a, b, 0.25 * depth, curved, false))
          EXPECT_NEAR(point.gap, -0.75 * depth - deeper, 1e-14);
      }
    }
  }
}

// Two ridges that cross, one 1e-4 m deep in the other.
TEST(ContactPoints, CountGapsOfCrossedEdgesFromWhereTheyWerePlaced) {
  const auto ridge = [](const Vector3& along, const Vector3& across, double edge, double back) {
    TriangleMesh mesh;
    for (const double end : {-1.0, 1.0}) {
      const Vector3 middle = end * along;
      mesh.points.push_back(middle + Vector3(0, 0, edge));
      mesh.points.push_back(middle + across + Vector3(0, 0, back));
      mesh.points.push_back(middle - across + Vector3(0, 0, back));
    }
    mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
      volume += mesh.points[at(a)].dot(mesh.points[at(b)].cross(mesh.points[at(c)]));
    if (volume < 0.0)
      for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    return Polyhedron(std::move(mesh));
  };
  Eigen::Isometry3d turned(Eigen::AngleAxisd(2.2, Vector3(1, 2, -1).normalized()));
  const MovedBody upper(ridge(Vector3::UnitX(), Vector3::UnitY(), -depth, 1.0 - depth), turned);
  const MovedBody lower(ridge(Vector3::UnitY(), Vector3::UnitX(), 0.0, -1.0), turned);
  for (const bool first : {false, true}) {
    const MovedBody& a = first ? upper : lower;
    const MovedBody& b = first ? lower : upper;
    const auto points = points_of(a, b, 2.0 * depth, true, false);
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points[0].type, ContactPointType::edge_edge);
    EXPECT_NEAR(points[0].overlap, depth, 1e-15);
    EXPECT_NEAR(points[0].gap, 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace ashlar::contact_points_test

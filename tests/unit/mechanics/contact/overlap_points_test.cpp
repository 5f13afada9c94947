#include "mechanics/contact/overlap_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "mechanics/basis/quadrature.hpp"
#include "mechanics/block/block_surface.hpp"
#include "support/simulations.hpp"

namespace ashlar::overlap_points_test {
namespace {

/// A box with the other diagonals: the mirror image of the box that the mirror makes the same.
TriangleMesh with_other_diagonals(const Vector3& low, const Vector3& high) {
  TriangleMesh mesh = make_box({-high.x(), low.y(), low.z()}, {-low.x(), high.y(), high.z()});
  for (Vector3& point : mesh.points) point.x() = -point.x();
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// A block that is bent and warped: its points move up by bend (x^2 + x y).
struct Body {
  BlockModel model;
  BlockState state = model.initial_state();
  BlockSurface surface{model, 0, Eigen::Matrix3d::Identity()};
  std::optional<PlacedSurface> placed;

  Body(TriangleMesh mesh, int order, double bend)
      : model(test_support::block_of("block", Polyhedron(std::move(mesh)), {2500, 1e9, 0.2}, order)) {
    std::vector<Vector3> points;
    for (int k = 0; k < 27; ++k) points.emplace_back(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    Eigen::MatrixX3d change = Eigen::MatrixX3d::Zero(27, 3);
    for (int k = 0; k < 27; ++k) {
      const Vector3& point = points[static_cast<std::size_t>(k)];
      change(k, 2) = bend * (point.x() * point.x() + point.x() * point.y());
    }
    state.position += model.basis().values(points).colPivHouseholderQr().solve(change);
    surface.move(state);
    surface.divide({std::numeric_limits<double>::infinity(), {}});
    placed.emplace(surface.placed());
  }
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
  [[nodiscard]] ContactBody contact() const { return {&model, &state, &*placed}; }
};

std::vector<ContactPoint> points_between(const Body& a, const Body& b, bool master_is_a) {
  const ContactLimits limits{0.1, 0.1, 10.0 * std::numbers::pi / 180.0};
  const PairContacts contacts = find_contacts(*a.placed, *b.placed, limits);
  const std::vector<bool> references_on_a(contacts.overlaps.size(), master_is_a);
  return contact_points(a.contact(), b.contact(), contacts, references_on_a, {}, {}).points;
}

const Vector3 low(-1, -0.5, -1);
const Vector3 high(1, 0.5, 0);
const Vector3 upper_low(-0.5, -0.25, 0);
const Vector3 upper_high(0.75, 0.5, 1);

TEST(OverlapPoints, TheDiagonalsOfTheMeshDoNotTell) {
  for (const int order : {1, 2, 3}) {
    for (const bool master_is_a : {false, true}) {
      const double bend = order == 1 ? 0.0 : -1e-3;
      const Body upper(make_box(upper_low, upper_high), order, bend);
      const Body other_upper(with_other_diagonals(upper_low, upper_high), order, bend);
      const Body lower(make_box(low, high), 2, 2e-3);
      const Body other_lower(with_other_diagonals(low, high), 2, 2e-3);
      const std::vector<ContactPoint> points = points_between(upper, lower, master_is_a);
      const std::vector<ContactPoint> others = points_between(other_upper, other_lower, master_is_a);
      EXPECT_FALSE(points.empty());
      ASSERT_EQ(points.size(), others.size());
      for (const ContactPoint& point : points) {
        double least = std::numeric_limits<double>::infinity();
        for (const ContactPoint& other : others) {
          least = std::min(least, (point.material_a - other.material_a).norm() +
                                      (point.material_b - other.material_b).norm() +
                                      (point.normal - other.normal).norm() + std::abs(point.gap - other.gap) +
                                      std::abs(point.area - other.area));
        }
        EXPECT_LT(least, 1e-12) << order << ": " << point.place_a.transpose();
      }
    }
  }
}

TEST(OverlapPoints, FacesThatAreNotDividedHaveOneRule) {
  const Body upper(make_box(upper_low, upper_high), 2, 0.0);
  const Body lower(make_box(low, high), 2, 0.0);
  const std::vector<ContactPoint> points = points_between(upper, lower, false);
  EXPECT_EQ(points.size(), polygon_rule({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 2).points.size());
  double area = 0.0;
  for (const ContactPoint& point : points) area += point.area;
  EXPECT_NEAR(area, 1.25 * 0.75, 1e-14);
}

TEST(OverlapPoints, BothMaterialPointsAreWhereTheTrueSurfacesAreSeen) {
  const Body upper(make_box(upper_low, upper_high), 2, -1e-3);
  const Body lower(make_box(low, high), 2, 2e-3);
  const std::vector<ContactPoint> points = points_between(upper, lower, false);
  EXPECT_FALSE(points.empty());
  for (const ContactPoint& point : points) {
    // Both surfaces are where the field puts them, and the gap is across the lower one.
    const Vector3& a = point.material_a;
    const Vector3& b = point.material_b;
    EXPECT_NEAR(a.z(), 0.0, 1e-14);
    EXPECT_NEAR(b.z(), 0.0, 1e-14);
    EXPECT_NEAR(point.place_a.z(), -1e-3 * (a.x() * a.x() + a.x() * a.y()), 1e-14);
    EXPECT_NEAR(point.place_b.z(), 2e-3 * (b.x() * b.x() + b.x() * b.y()), 1e-14);
    EXPECT_NEAR((point.place_a - point.place_b).cross(point.normal).norm(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace ashlar::overlap_points_test

#include "geometry/contacts/cell_overlap.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "support/placed_bodies.hpp"

namespace ashlar::cell_overlap_test {
namespace {

using test_support::PlacedBody;

/// A number between -1 and 1.
double any(std::mt19937_64& random) {
  return 0x1p-52 * static_cast<double>(random() >> 11) - 1.0;
}

// Two boxes on each other whose corners are off by last bits, in any orientation: rims cross where rounding
// wills. Every corner is a place on both rims, none is lost in a quotient of zeros.
TEST(CellOverlap, RimsOnEachOtherCrossOnBoth) {
  std::mt19937_64 random(20261121);
  int corners = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Eigen::Matrix3d turn = Eigen::Quaterniond(any(random), any(random), any(random), any(random))
                                     .normalized()
                                     .toRotationMatrix();
    const auto moved = [&](const Polyhedron& solid) {
      std::vector<Vector3> points;
      for (const Vector3& x : solid.mesh().points) {
        Vector3 place = trial % 2 == 0 ? x : Vector3(turn * x);
        for (double& component : place) {
          const int bits = static_cast<int>(random() % 5) - 2;
          component += bits * 0x1p-53;
        }
        points.push_back(place);
      }
      return points;
    };
    const PlacedBody above(test_support::box({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
    const PlacedBody below(test_support::box({-0.5, -0.5, -1}, {0.5, 0.5, 0}));
    const PlacedSurface a(above.surface, moved(above.solid));
    const PlacedSurface b(below.surface, moved(below.solid));
    DecisionCounts counts;
    for (int i = 0; i < static_cast<int>(a.surface().cells.size()); ++i) {
      for (int j = 0; j < static_cast<int>(b.surface().cells.size()); ++j) {
        if (a.normal(i).dot(b.normal(j)) > -0.9) continue;
        const auto overlap = overlap_of_cells(a, i, b, j, counts);
        if (!overlap) continue;
        for (std::size_t k = 0; k < overlap->corners.size(); ++k) {
          ++corners;
          const Eigen::Vector2d& place = overlap->corners[k].place;
          ASSERT_TRUE(place.allFinite() && std::isfinite(overlap->gaps[k])) << trial;
          // Over both faces, squares of half diagonal sqrt(1/2) about points that differ by rounding.
          const Vector3 point =
              overlap->frame.origin + place.x() * overlap->frame.e1 + place.y() * overlap->frame.e2;
          const auto over = [&](const PlacedSurface& s, int cell) {
            Vector3 middle = Vector3::Zero();
            const auto loop = s.corners(cell);
            for (const Vector3& corner : loop) middle += corner / static_cast<double>(loop.size());
            const Vector3 flat = point - middle - overlap->frame.w.dot(point - middle) * overlap->frame.w;
            return flat.norm() < std::sqrt(0.5) + 1e-14;
          };
          EXPECT_TRUE(over(a, i) && over(b, j)) << trial << ": " << point.transpose();
        }
      }
    }
  }
  EXPECT_GT(corners, 1000);
}

}  // namespace
}  // namespace ashlar::cell_overlap_test

#include "apps/program/verify/sliding_wedge.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace ashlar {
namespace {

/// Outward normal of a plane that dips by an angle towards a direction (from the north, +y, to the east, +x).
Vector3 normal_of_plane(double dip, double direction) {
  constexpr double degree = std::numbers::pi / 180.0;
  return {std::sin(dip * degree) * std::sin(direction * degree),
          std::sin(dip * degree) * std::cos(direction * degree), std::cos(dip * degree)};
}

}  // namespace

SlidingWedge::SlidingWedge() : n1(normal_of_plane(40, 130)), n2(normal_of_plane(60, 220)) {
  line = n1.cross(n2).normalized();
  if (line.z() > 0.0) line = -line;
  d1 = n1.cross(line);
  if (d1.dot(n2) < 0.0) d1 = -d1;
  d2 = n2.cross(line);
  if (d2.dot(n1) < 0.0) d2 = -d2;
  // N1 n1 + N2 n2 balances the part of the weight normal to the line.
  Eigen::Matrix3d directions;
  directions << n1, n2, line;
  const Vector3 parts = directions.inverse() * Vector3::UnitZ();
  grip = parts[0] + parts[1];
  slip = -parts[2];
}

void SlidingWedge::add_to(ContactScene& scene, const Material& material) const {
  for (const auto& [n, d] : {std::pair{n1, d1}, {n2, d2}}) {
    std::vector<Vector3> points;
    for (const double along : {-3.0, 9.0}) {
      for (const double up : {-0.5, 3.0}) {
        for (const double depth : {0.0, 1.0}) points.emplace_back(along * line + up * d - depth * n);
      }
    }
    scene.add_fixed(hull_of(points));
  }
  std::vector<Vector3> points;
  for (const double along : {-1.0, 1.0}) {
    points.emplace_back(along * line);
    points.emplace_back(along * line + d1);
    points.emplace_back(along * line + d2);
  }
  scene.add(define_block(hull_of(points), material, 1));
}

}  // namespace ashlar

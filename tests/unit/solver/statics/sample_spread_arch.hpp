// A semicircular arch on a support that has moved, as two rigid parts of each half between three hinges: by hand.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sample_limits.hpp"

namespace ashlar::test_support {

/// From y = 0 to 1. @param outline (x, z), convex
inline Polyhedron prism(const std::vector<std::array<double, 2>>& outline) {
  std::vector<Vector3> points;
  for (const auto& [x, z] : outline)
    for (const double y : {0.0, 1.0}) points.emplace_back(x, y, z);
  return Polyhedron(make_convex_hull(points));
}

using Point = Eigen::Vector2d;  // x to the right, z up

/// A semicircular arch of equal voussoirs, mean radius 1 m, 1 m deep, about the origin. Joint k is at the angle
/// -90 + 180 k / n degrees from the vertical.
struct RoundArch {
  int count;
  double thickness;

  [[nodiscard]] Point at(double radius, int joint) const {
    const double angle = std::numbers::pi * (static_cast<double>(joint) / count - 0.5);
    return {radius * std::sin(angle), radius * std::cos(angle)};
  }
  [[nodiscard]] Point inner(int joint) const { return at(1.0 - 0.5 * thickness, joint); }
  [[nodiscard]] Point outer(int joint) const { return at(1.0 + 0.5 * thickness, joint); }
  [[nodiscard]] std::vector<Point> voussoir(int k) const {
    return {inner(k), outer(k), outer(k + 1), inner(k + 1)};
  }
  /// The last two blocks are the supports.
  [[nodiscard]] LimitScene scene() const {
    LimitScene scene;
    scene.law = joint(1.0);
    for (int k = 0; k < count; ++k) {
      std::vector<std::array<double, 2>> outline;
      for (const Point& p : voussoir(k)) outline.push_back({p.x(), p.y()});
      scene.add(std::to_string(k), prism(outline));
    }
    for (const double side : {-1.0, 1.0})
      scene.add_fixed(prism({{0.5 * side, 0}, {1.5 * side, 0}, {1.5 * side, -0.3}, {0.5 * side, -0.3}}));
    return scene;
  }
};

/// Weight and its moment about the origin of a polygon that is 1 m deep.
struct Weight {
  double force = 0.0;
  Point place = Point::Zero();
};
inline Weight weight_of(const std::vector<Point>& polygon) {
  double area = 0.0;
  Point first = Point::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double cross = p.x() * q.y() - p.y() * q.x();
    area += 0.5 * cross;
    first += cross / 6.0 * (p + q);
  }
  return {rock.density * g * std::abs(area), first / area};
}

/// The right half of a spread arch as two rigid parts: from a hinge at the crown's outer side to one at the inner side of
/// a joint of the haunch, and from there on, on the support.
class SpreadArch {
 public:
  SpreadArch(const RoundArch& arch, int haunch, double spread) : arch_(arch), haunch_(haunch) {
    shift_ = Point(0.5 * spread, 0.0);
    const Point crown = arch.outer(arch.count / 2);
    hinge_ = arch.inner(haunch) + shift_;
    const double bar = (crown - arch.inner(haunch)).norm();
    crown_ = Point(0.0, hinge_.y() + std::sqrt(bar * bar - hinge_.x() * hinge_.x()));
    const auto direction = [](const Point& d) { return std::atan2(d.y(), d.x()); };
    turn_ = Eigen::Rotation2Dd(direction(crown_ - hinge_) - direction(crown - arch.inner(haunch)));
    double moment = 0.0;
    for (int k = arch.count / 2; k < haunch; ++k) {
      const Weight weight = placed(weight_of(arch.voussoir(k)), k);
      moment += weight.force * (hinge_.x() - weight.place.x());
    }
    thrust_ = moment / (crown_.y() - hinge_.y());
  }

  [[nodiscard]] double thrust() const { return thrust_; }

  /// True if the line of thrust is between both sides of all joints.
  [[nodiscard]] bool stands() const {
    for (int k = arch_.count / 2 + 1; k <= arch_.count; ++k) {
      constexpr double rounding = 1e-9;  // the line touches the hinge itself
      const double inner = moment(k, arch_.inner(k)), outer = moment(k, arch_.outer(k));
      if (inner < -rounding * thrust_ || outer > rounding * thrust_) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] Point placed(const Point& point, int voussoir) const {
    if (voussoir >= haunch_) return point + shift_;
    return hinge_ + turn_ * (point - arch_.inner(haunch_));
  }
  [[nodiscard]] Weight placed(const Weight& weight, int voussoir) const {
    return {weight.force, placed(weight.place, voussoir)};
  }
  /// Moment of crown thrust and weights above a joint about a point of it, > 0 if they pass it on its outer side.
  [[nodiscard]] double moment(int joint, const Point& point) const {
    const Point about = placed(point, joint - 1);
    double sum = thrust_ * (crown_.y() - about.y());
    for (int k = arch_.count / 2; k < joint; ++k) {
      const Weight weight = placed(weight_of(arch_.voussoir(k)), k);
      sum -= weight.force * (about.x() - weight.place.x());
    }
    return sum;
  }

  RoundArch arch_;
  int haunch_;
  Point shift_, hinge_, crown_;
  Eigen::Rotation2Dd turn_;
  double thrust_ = 0.0;
};

}  // namespace ashlar::test_support

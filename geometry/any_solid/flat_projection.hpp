// Points of two faces seen along a direction, on a coordinate plane, and exact signs between them.
//
// A number of the projection is rational. It goes with a double that has a bound of its error, which decides most
// signs. Only sources of this layer include this file.
#pragma once

#include "geometry/exact/predicate_ladder.hpp"
#include "geometry/exact/rational_vector.hpp"
#include "geometry/exact/tracked_number.hpp"

namespace ashlar {

/// A number of the projection: exact, and as a double with a bound of its error.
struct Coordinate {
  Rational exact;
  TrackedNumber tracked;
};

/// @param is_double true if the number is a double itself, which has no error
[[nodiscard]] Coordinate coordinate(Rational exact, bool is_double);

/// No value that the number stands for is below or above these.
[[nodiscard]] double least_value(const TrackedNumber& n);
[[nodiscard]] double greatest_value(const TrackedNumber& n);

struct PlanePoint {
  Coordinate u, v;
};

/// Signs in the projection.
class PlaneSigns {
 public:
  /// @param floating no product of two coordinates overflows
  PlaneSigns(bool floating, DecisionCounts& counts) : floating_(floating), counts_(counts) {}

  /// 1 if p, q, r turn left.
  [[nodiscard]] int turn(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r) const;
  /// Sign of x - y.
  [[nodiscard]] int compare(const Coordinate& x, const Coordinate& y) const;
  /// True if a point of the line through two different points is strictly between them.
  [[nodiscard]] bool is_between(const PlanePoint& p, const PlanePoint& q, const PlanePoint& x) const;

 private:
  [[nodiscard]] int certain_sign(const TrackedNumber& value) const;

  bool floating_;
  DecisionCounts& counts_;
};

/// Along a direction to a coordinate plane; left stays left.
class FlatProjection {
 public:
  /// @param direction not zero
  /// @param coplanar all points are in one plane across the direction
  FlatProjection(const RationalVector& direction, bool coplanar);

  [[nodiscard]] PlanePoint operator()(const Vector3& x) const {
    return {project(x, first_, first_slope_), project(x, second_, second_slope_)};
  }
  /// (true area / projected area)^2 of faces across the direction.
  [[nodiscard]] const Rational& squared_scale() const { return squared_scale_; }

 private:
  [[nodiscard]] Coordinate project(const Vector3& x, int axis, const Rational& slope) const;

  bool coplanar_;
  int dropped_ = 0, first_ = 0, second_ = 0;
  Rational first_slope_, second_slope_, squared_scale_;
};

}  // namespace ashlar

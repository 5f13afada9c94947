// The motion of a support given by a record: rows of displacements, velocities or accelerations, and a polynomial of
// time of degree 3 or less between them.
//
//   displacement         u linear between rows: the velocity jumps at each row
//   smooth_displacement  u a cubic spline through the rows, twice continuously differentiable, at rest at the
//                        first and at the last row: rows of a motion that begins and ends at rest leave no
//                        jump of velocity anywhere
//   velocity             v linear between rows, u = integral of v; at rest before the first row
//   acceleration         a linear between rows, v and u its integrals; at rest before the first row
// The integrals are those of the polynomials: exact but for rounding.
//
// After the last row a displacement or a velocity is constant and an acceleration is zero, so that a support
// continues with the velocity at the end of its record.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ashlar {

/// Quantity of the rows of a history; see the head of this file.
enum class MotionRecord {
  displacement,         ///< m
  smooth_displacement,  ///< m
  velocity,             ///< m/s
  acceleration,         ///< m/s^2
};

/// Motion of a support over time; none if there are no rows.
struct SupportHistory {
  std::vector<double> times;    ///< s, increasing
  std::vector<Vector3> values;  ///< same number, see record
  MotionRecord record = MotionRecord::displacement;

  friend bool operator==(const SupportHistory&, const SupportHistory&) = default;
};

/// A history as a function of time.
class RecordedMotion {
 public:
  /// @param history not empty. @throws std::domain_error if its integrals or its spline are not finite in
  /// double precision
  explicit RecordedMotion(const SupportHistory& history);

  /// True if the velocity is defined at all times except the end of a jump to another displacement: for all records
  /// but displacements that are linear between rows.
  [[nodiscard]] bool smooth() const { return smooth_; }
  [[nodiscard]] Vector3 displacement(double time) const;  ///< m
  /// m/s; at a jump the value after it.
  [[nodiscard]] Vector3 velocity(double time) const;
  /// m/s^2; at a jump the value after it.
  [[nodiscard]] Vector3 acceleration(double time) const;
  /// True if the displacement may differ between two times.
  [[nodiscard]] bool changes_between(double start, double end) const;
  /// Times of the rows, s.
  [[nodiscard]] std::vector<double> times() const;
  /// Largest component of a displacement until a time, m, accurate to a few per cent between rows.
  [[nodiscard]] double farthest_until(double time) const;

 private:
  /// u, v, a at its start and the constant rate of a, until the next piece.
  struct Piece {
    double start;
    Vector3 u = Vector3::Zero(), v = Vector3::Zero(), a = Vector3::Zero(), jerk = Vector3::Zero();

    [[nodiscard]] Vector3 displacement_after(double s) const;
    [[nodiscard]] Vector3 velocity_after(double s) const;
    [[nodiscard]] bool moves() const;
  };
  [[nodiscard]] const Piece& piece_at(double time) const;

  std::vector<Piece> pieces_;  ///< one from minus infinity on, then one from each row on
  bool smooth_;
};

/// End conditions of a cubic spline.
enum class SplineEnds {
  at_rest,  ///< zero
  natural,  ///< zero second derivative
};

/// Slopes at the points of a cubic spline whose second derivative is continuous.
/// @param times increasing, two or more. @param values same number. @return same number
[[nodiscard]] std::vector<Vector3> spline_slopes(const std::vector<double>& times,
                                                 const std::vector<Vector3>& values, SplineEnds ends);

}  // namespace ashlar

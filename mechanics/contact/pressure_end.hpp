// Where pressure ends inside an overlap that is in part open. There the pressure has a kink, which one
// quadrature rule over the whole overlap would spread over a fifth of it: a wall that is pushed would stand
// 10 % too much. The overlap is cut along the line where its gap is 0, and each part has its own rule.
//
// Points must not move with every breath of a joint: slip is remembered by points, and friction near its
// limit would creep. A cut stays where it is in the material until pressure ends elsewhere.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "mechanics/basis/quadrature.hpp"

namespace ashlar {

/// A line in the plane of an overlap.
struct PressureEnd {
  Eigen::Vector2d point;  ///< on the line
  Eigen::Vector2d open;   ///< across the line, any length, to the side without pressure
};

/// What is remembered of a cut between two cells from step to step.
struct PressureCut {
  int cell_a;
  int cell_b;
  bool of_a;      ///< in whose material it is: the slave's, whose points are carried along
  Vector3 start;  ///< two places on the line, the open side to the left, m
  Vector3 end;
};

/// The part of a convex polygon under pressure. @param polygon counter-clockwise
/// @return counter-clockwise, fewer than 3 corners if there is none
[[nodiscard]] std::vector<Eigen::Vector2d> part_under_pressure(const std::vector<Eigen::Vector2d>& polygon,
                                                               const PressureEnd& end);

/// The other part.
[[nodiscard]] std::vector<Eigen::Vector2d> part_without_pressure(const std::vector<Eigen::Vector2d>& polygon,
                                                                 const PressureEnd& end);

/// The line at which to cut an overlap: where the affine function nearest to the gaps is 0, if at least half
/// of how they vary is affine (a quarter where it was cut before, even if no point of the rule is under
/// pressure: what a cut changes must not undo it), or the known line if what is under pressure differs by at
/// most a twentieth of its area; the pressure is wrong by the square of that.
/// @param polygon the overlap, counter-clockwise. @param rule of the whole overlap. @param gaps at its
/// points, m. @param tolerance m, gaps within it count as 0: rounding must not cut what is flush
/// @param known line of the last step, nothing if there was none
/// @return nothing where the overlap should not be cut
[[nodiscard]] std::optional<PressureEnd> end_of_pressure(const std::vector<Eigen::Vector2d>& polygon,
                                                         const PolygonRule& rule,
                                                         const std::vector<double>& gaps, double tolerance,
                                                         const std::optional<PressureEnd>& known);

}  // namespace ashlar

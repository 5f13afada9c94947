// End of the pressure inside an overlap that is partly open. The pressure has a kink there, which one quadrature rule
// would smear over a fifth of the overlap: a pushed wall would resist 10 % too much. The overlap is cut along the
// line of zero gap, and each part has its own rule.
//
// Points must not move with small motions of a joint: slip is remembered by points, and friction near its limit would
// creep. A cut is fixed in the material until the end of pressure has moved.
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
  Eigen::Vector2d open;   ///< normal to the line, any length, towards the side without pressure
};

/// Memory of a cut between two cells from step to step.
struct PressureCut {
  int cell_a;
  int cell_b;
  bool of_a;      ///< true: in the material of a, the block without the reference face; its points are
                  ///< carried along
  Vector3 start;  ///< two places on the line, the open side to the left, m
  Vector3 end;
};

/// The part of a convex polygon under pressure. @param polygon counter-clockwise
/// @return counter-clockwise, fewer than 3 corners if empty
[[nodiscard]] std::vector<Eigen::Vector2d> part_under_pressure(const std::vector<Eigen::Vector2d>& polygon,
                                                               const PressureEnd& end);

/// The other part.
[[nodiscard]] std::vector<Eigen::Vector2d> part_without_pressure(const std::vector<Eigen::Vector2d>& polygon,
                                                                 const PressureEnd& end);

/// The line at which to cut an overlap. It is the zero line of the affine function closest to the gaps, if at least
/// half of their variation is affine. A quarter suffices if the overlap was cut before, even if no point of the rule
/// is under pressure: the effect of a cut must not undo it. The known line is kept if the part under pressure differs
/// by at most a twentieth of its area; the error of the pressure is of the square of that.
/// @param polygon the overlap, counter-clockwise. @param rule of the whole overlap. @param gaps at its points, m.
/// @param tolerance m, smaller gaps count as 0: rounding must not cut flush faces
/// @param known line of the last step, empty if there was none
/// @return empty if the overlap should not be cut
[[nodiscard]] std::optional<PressureEnd> end_of_pressure(const std::vector<Eigen::Vector2d>& polygon,
                                                         const PolygonRule& rule,
                                                         const std::vector<double>& gaps, double tolerance,
                                                         const std::optional<PressureEnd>& known);

}  // namespace ashlar

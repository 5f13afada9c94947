// Operator splitting (ADMM): bodies and the laws of contact points are solved in turn, coupled by a spring at every point,
// so that all points change at once. It finds which points stick, slide and part where Newton's method, which finishes
// what it begins, does not from afar: in impacts (step/impact/impact_splitting.hpp) and in hard steps
// (step/solve/proximal_guess.hpp).
//
//   bodies  (A + G' H G) x = b + G' (f + H (v - s0))         s = s0 + G x
//   points  f+ - f = H (v+ - y),  f+ by the law at v+        y = 1.6 s - 0.6 v
//
// x is the change of the bodies, A and b their equations without contact, G the rows of the points. Coulomb's law has no
// potential, so that convergence is not proven: the best answer met is returned.
// S. Boyd et al., Distributed optimization and statistical learning via ADMM, Found. Trends Mach. Learn. 3 (2011) 1.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ashlar {

/// A point along its normal and tangents: places in m with forces in N, or velocities in m/s with impulses in N s.
struct SplitPoint {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();    ///< s0, place without change of the bodies
  Eigen::Vector3d place = Eigen::Vector3d::Zero();    ///< s, of the bodies
  Eigen::Vector3d copy = Eigen::Vector3d::Zero();     ///< v, of the law
  Eigen::Vector3d last = Eigen::Vector3d::Zero();     ///< v before the last projection
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< f, of the law
  Eigen::Vector3d penalty = Eigen::Vector3d::Zero();  ///< H, force per place

  /// Load on the bodies, f + H (v - s0).
  [[nodiscard]] Eigen::Vector3d load() const { return force + penalty.cwiseProduct(copy - first); }
  /// Resistance to their change, H (s - s0).
  [[nodiscard]] Eigen::Vector3d resistance() const { return penalty.cwiseProduct(place - first); }
};

/// Solves all points. @param law (index, y, point), which updates force and copy of the point
template <class Law>
void relax_and_project(std::vector<SplitPoint>& points, const Law& law) {
  constexpr double relaxation = 1.6;
  for (std::size_t k = 0; k < points.size(); ++k) {
    SplitPoint& point = points[k];
    point.last = point.copy;
    law(k, Eigen::Vector3d(relaxation * point.place + (1.0 - relaxation) * point.copy), point);
  }
}

/// Adapts penalties 1/(rho d) with constant d: stiffer if bodies and points differ by more than the points change,
/// relative to forces and places, softer in the opposite case. Points of penalty 0 do not count.
/// @param points after a projection, each of one penalty along all axes. @return rho
[[nodiscard]] inline double adapted_rho(double rho, const std::vector<SplitPoint>& points) {
  constexpr double unequal = 5.0, factor = 2.0;
  constexpr double least = 1e-6, most = 1e3;  // extreme values follow a ratio that rounding decides
  // Energies, so that points of light and heavy bodies count alike.
  double gap = 0.0, change = 0.0, of_forces = 0.0, of_places = 0.0;
  for (const SplitPoint& point : points) {
    const double penalty = point.penalty[0];
    if (!(penalty > 0.0)) continue;
    gap += (point.place - point.copy).squaredNorm() * penalty;
    change += (point.copy - point.last).squaredNorm() * penalty;
    of_forces += point.force.squaredNorm() / penalty;
    of_places += point.copy.squaredNorm() * penalty;
  }
  gap = std::sqrt(gap * of_forces);
  change = std::sqrt(change * of_places);
  if (gap > unequal * change) rho /= factor;
  if (change > unequal * gap) rho *= factor;
  return std::clamp(rho, least, most);
}

struct SplittingLimits {
  int passes;               ///< at most
  int between_checks;       ///< passes from one check of the residual to the next
  double enough;            ///< residual that ends the passes
  int between_changes = 0;  ///< passes from one change of H to the next, a multiple of these; 0: constant
};

template <class Answer>
struct SplitAnswer {
  Answer best;                                                ///< of those checked
  double residual = std::numeric_limits<double>::infinity();  ///< of it; infinite: none was found
};

/// @param system has `solve_bodies()`, which sets s or, without a solution, returns false and ends the passes,
/// `project_points()`, which sets f and v, `answer()` with its `residual()`, and `adapt()` if it changes H
template <class Answer, class System>
[[nodiscard]] SplitAnswer<Answer> solve_by_splitting(System& system, const SplittingLimits& limits) {
  SplitAnswer<Answer> found{system.answer()};
  for (int pass = 1; pass <= limits.passes && system.solve_bodies(); ++pass) {
    system.project_points();
    if (pass % limits.between_checks != 0) continue;
    const double residual = system.residual();
    if (residual < found.residual) found = {system.answer(), residual};
    if (found.residual <= limits.enough) break;
    if constexpr (requires { system.adapt(); })
      if (limits.between_changes > 0 && pass % limits.between_changes == 0) system.adapt();
  }
  return found;
}

}  // namespace ashlar

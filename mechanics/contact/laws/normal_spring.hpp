// The normal spring of a contact point: linear, or stiffer the more the joint is closed (Bandis, Lumsden and Barton, Int. J.
// Rock Mech. 20 (1983) 249). With the closure c >= 0, the initial stiffness k and the largest closure v
//     N(c) = k c / (1 - x),      E(c) = k v^2 (-x - ln(1 - x)),      x = c / v.
// Unloading returns along the same curve. From x = 0.99 on, under 99 k v, N goes on along its tangent, so that every guess of
// a step has a force. In tension, c < 0, the spring is linear.
#pragma once

#include <limits>

namespace ashlar {

/// Mean force over a change of closure.
struct MeanCompression {
  double force;  ///< N, >= 0
  double slope;  ///< derivative by the closure at the end, N/m, >= 0
};

struct NormalSpring {
  /// Closure from which on the tangent replaces the curve, over the largest closure.
  static constexpr double end_of_curve = 0.99;

  double stiffness = 0.0;                                            ///< N/m: k
  double largest_closure = std::numeric_limits<double>::infinity();  ///< m, > 0: v; infinite: linear

  /// True if it is not linear.
  [[nodiscard]] bool stiffens() const { return largest_closure < std::numeric_limits<double>::infinity(); }
  /// @param closure m, any sign. @return N, of the sign of the closure
  [[nodiscard]] double force(double closure) const {
    return stiffens() && closure > 0.0 ? force_of_curve(closure) : stiffness * closure;
  }
  /// Derivative of the force, N/m.
  [[nodiscard]] double slope(double closure) const {
    return stiffens() && closure > 0.0 ? slope_of_curve(closure) : stiffness;
  }
  /// Energy that it holds, J. @param closure m, any sign
  [[nodiscard]] double energy(double closure) const {
    return stiffens() && closure > 0.0 ? work(0.0, closure) : 0.5 * stiffness * closure * closure;
  }
  /// Share of the largest closure. 0 for a linear spring. @param closure m
  [[nodiscard]] double closed_share(double closure) const { return closure / largest_closure; }
  /// Degree of Gauss's rules whose forces are right to 1e-3 where the closure is linear between two; 0: any
  /// (../../notes/joint_closure.md). @param from,to m, any signs, from <= to
  [[nodiscard]] int needed_degree(double from, double to) const;
  /// Inverse of force(). @param force N, any sign. @return m
  [[nodiscard]] double closure(double force) const;
  /// Mean of the force over a linear change of closure, without tension: its work is the change of energy.
  /// @param from,to closures, m, any signs
  [[nodiscard]] MeanCompression mean_compression(double from, double to) const;

 private:
  [[nodiscard]] double force_of_curve(double closure) const;
  [[nodiscard]] double slope_of_curve(double closure) const;
  /// Work of the compressive force, J. @param from,to m, from <= to
  [[nodiscard]] double work(double from, double to) const;
};

}  // namespace ashlar

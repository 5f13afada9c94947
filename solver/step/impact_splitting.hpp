// Impulses of an impact by operator splitting (ADMM): bodies and points in turn, coupled by a spring at every point, so
// that all points change at once. It converges in stacks, and where many points hold a few bodies, in which
// Gauss-Seidel needs a number of sweeps that grows with the square of their height. With z, j, u, t of impact.hpp, K
// the cone |j_t| <= tan(phi) j_n of a point (all forces for a bond), y the velocity after the impact:
//
//   bodies  (M + G' R G) z = G' (j + R (y - w))              w = u - t e_n + s e_n
//   points  j+ = P_K(j - R v),  y = v + (j+ - j)/R           v = 1.6 (G z + w) - 0.6 y,  s = tan(phi) |y_t|
//
// P_K is the projection. R = 1/(rho d), d the mean mobility of the point; rho follows the ratio of the changes of j and
// of y. The shift s makes the projection Coulomb's law (G. de Saxce and Z.-Q. Feng, Math. Comput. Model. 28 (1998)
// 225); with it, convergence is not proven. The splitting: S. Boyd et al., Distributed optimization and statistical
// learning via ADMM, Found. Trends Mach. Learn. 3 (2011) 1.
//
// No order of points enters. One factor serves all iterations between two changes of rho.
#pragma once

#include "solver/step/impact.hpp"

namespace ashlar {

struct SplitImpulses {
  std::vector<Eigen::Vector3d> impulses;  ///< best of those checked, by point, N s on a along (n, t1, t2)
  double residual = 0.0;                  ///< of these, as ImpactResult::residual
  int iterations = 0;
};

/// @param inertia,sizes,points as for solve_impact
/// @param accuracy of the residual that ends the iteration. @param iterations at most; checked every tenth
[[nodiscard]] SplitImpulses split_impulses(const std::vector<double>& inertia, const std::vector<int>& sizes,
                                           const std::vector<ImpactPoint>& points, double accuracy,
                                           int iterations);

/// Residual of Coulomb's law, of the largest velocity of a point before: change of the velocity of a point, by itself,
/// that makes its impulse obey the law. 0 without velocities
[[nodiscard]] double impact_residual(const std::vector<double>& inertia, const std::vector<int>& sizes,
                                     const std::vector<ImpactPoint>& points,
                                     const std::vector<Eigen::Vector3d>& impulses);

}  // namespace ashlar

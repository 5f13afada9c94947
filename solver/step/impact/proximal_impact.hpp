// Impulses of an impact by a proximal point method. With z, j, M, G and u of impact.hpp, w(z) the velocity of a point
// after the impact less its target, and P_K the projection on the cone |j_t| <= tan(phi) j_n of a point (all impulses
// for a bond), each pass solves
//
//   M z = sum of G' j+,   j+ = P_K(j - r (w(z) + s e_n)),   r = 1/(c d)
//
// for z, with the impulses j of the last pass, d the mean mobility of a point. s = tan(phi) |w_t(z)| makes the
// projection Coulomb's law (G. de Saxce and Z.-Q. Feng, Math. Comput. Model. 28 (1998) 225). Newton's method solves the
// pass with this shift (piecewise smooth, not symmetric). Where it fails the shift is that of the last pass: z is then
// the minimum of a convex function, which Newton's method with a line search finds. c, the compliance of a pass, falls
// from pass to pass: j converges as fast as c is small, and a small c is hard to solve from a distant start.
//
// Each pass ends. The best impulses are returned, with their residual. No order of points or bodies enters.
#pragma once

#include "solver/step/impact/impact_bodies.hpp"

namespace ashlar {

/// Compliance of the passes: first, factor from pass to pass, least.
struct Compliance {
  double first = 1e-2;
  double factor = 0.3;
  double least = 1e-6;
};

/// @param start impulses to begin with. @param accuracy of the residual that ends the passes. @param passes at most, > 0
[[nodiscard]] FoundImpulses proximal_impulses(const ImpactBodies& bodies, const FoundImpulses& start,
                                              const Compliance& compliance, double accuracy, int passes);

}  // namespace ashlar

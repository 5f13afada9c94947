// Impulses of an impact by operator splitting (ADMM): bodies and points in turn, coupled by a spring at every point, so
// that all points change at once. It finds which points stick, slide and part where Newton's method does not from afar
// (proximal_impact.hpp), which finishes what it begins. With z, j, u, t of impact.hpp, K the cone
// |j_t| <= tan(phi) j_n of a point (all impulses for a bond), y the velocity after the impact:
//
//   bodies  (M + G' R G) z = G' (j + R (y - w))              w = u - t e_n + s e_n
//   points  j+ = P_K(j - R v),  y = v + (j+ - j)/R           v = 1.6 (G z + w) - 0.6 y,  s = tan(phi) |y_t|
//
// P_K is the projection. R = 1/(rho d), d the mean mobility of the point; rho follows the ratio of the changes of j and
// of y. The shift s makes the projection Coulomb's law; with it, convergence is not proven. The splitting: S. Boyd et
// al., Distributed optimization and statistical learning via ADMM, Found. Trends Mach. Learn. 3 (2011) 1.
#pragma once

#include "solver/step/impact/impact_bodies.hpp"

namespace ashlar {

/// @param accuracy of the residual that ends the iteration. @param iterations at most; checked every tenth
/// @return best of those checked
[[nodiscard]] FoundImpulses split_impulses(const ImpactBodies& bodies, double accuracy, int iterations);

}  // namespace ashlar

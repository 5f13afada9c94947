// Impulses of an impact by operator splitting (linear/splitting.hpp), which proximal_impact.hpp finishes. Places are
// velocities, forces are impulses. With M, u, t of impact.hpp and P_K the projection on the cone |f_t| <= tan(phi) f_n of
// a point (all impulses for a bond):
//
//   A = M,  b = 0,  s0 = u - t e_n + tan(phi) |v_t| e_n,  f+ = P_K(f - H y),  H = 1/(rho d)
//
// d is the mean mobility of the point; rho is adapted. The shift by v makes the projection Coulomb's law.
#pragma once

#include "solver/step/impact/impact_bodies.hpp"

namespace ashlar {

/// @param accuracy of the residual that ends the iteration. @param iterations at most; checked every tenth
/// @return best of those checked
[[nodiscard]] FoundImpulses split_impulses(const ImpactBodies& bodies, double accuracy, int iterations);

}  // namespace ashlar

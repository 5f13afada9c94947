// Forces of a contact point whose bond has fracture energy (bond_damage.hpp). Such a point has springs, no multipliers,
// neither dilation nor dashpots, and no residual strength beside its friction.
//
// At the end of a step with opening g and trial shear force ks s, f = max(N, 0) tan(phi), D0 the damage at its start:
//     D = max(D0, (g - w0)/(wf - w0), D0 + (ks s - f - C (1 - D0))/(ks pf - C)),  at most 1;   C = c A
// The last is the slip p = pf (D - D0) for which  ks (s - p) = f + C (1 - D).  Then
//     N = -K(D) g for g > 0, -kn g for g < 0;   the shear force is at most f + C (1 - D).
//
// The tangent has the secant K(D) of an opening bond. The energy of an opening bond is concave in g^2, so that
// minimisation with secants does not increase it. The falling part of the Jacobian is in the coupling, a product of one
// column and one row: whichever raises D, opening or slip, D depends on one of them.
#pragma once

#include "mechanics/contact/laws/joint_law.hpp"

namespace ashlar {

/// Bond of a point without damage. @param law with fracture energy. @param area of the point, m^2
[[nodiscard]] BondDamage bond_of(const JointLaw& law, double area);

/// As point_response(), of a law whose bond softens.
[[nodiscard]] PointResponse softened_response(const PointLaw& law, double gap, const Eigen::Vector2d& slip);

/// Bound of the shear force at the end of a step, N, as MeanResponse::limit. @param end softened_response()
[[nodiscard]] double softened_limit(const PointLaw& law, const PointResponse& end);

/// As averaged_step(), of a law whose bond softens. The work of the mean normal force is exactly the change of the
/// spring's energy and the dissipation of damage. Cohesion acts with its mean over the slip of the step, so that the
/// dissipation in shear is exact too.
[[nodiscard]] AveragedStep softened_step(const PointLaw& law, const PointResponse& start,
                                         const Eigen::Vector3d& start_place,
                                         const Eigen::Vector3d& end_place);

}  // namespace ashlar

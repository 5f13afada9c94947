// Motion of rigid blocks whose joints obey Coulomb's law. Friction |t| <= c + mu N acts against the slip, and a joint that
// slides opens by its dilation angle psi only, where the associated flow of a cone programme opens it by mu.
//
// Such motion is not unique, and equilibrium may exist beside it. Two ways find it:
//   motion from rest  The accelerations of one instant. Each point in turn takes the force that Coulomb's law gives it
//                     while the others keep theirs (block Gauss-Seidel; Jourdan, Alart and Jean, Comput. Methods Appl.
//                     Mech. Eng. 155 (1998) 31). What it converges to is a motion, or rest. Which one of several
//                     solutions it is depends on the forces that it starts from.
//   slow slip         Motion so slow that forces stay in balance. With the shift s = (mu - tan psi) |v_t| of each point
//                     the programme `slow` (cone_program.hpp) turns one slip into the next one. The map is homogeneous:
//                     slip grows or decays by a factor, and the factor 1 is the limit (de Saxce and Feng, Math. Comput.
//                     Model. 28 (1998) 225, for the shift).
// Slow slip finds where motion sets in gradually. Motion from rest finds where it sets in with a finite acceleration,
// which slow slip does not see.
#pragma once

#include <vector>

#include "solver/statics/cone_program.hpp"

namespace ashlar {

enum class LimitOutcome {
  stands,   ///< nothing moves
  moves,    ///< a motion was found
  unknown,  ///< the iteration did not settle
};

struct ReleasedMotion {
  LimitOutcome outcome = LimitOutcome::unknown;
  std::vector<BodyVelocity> velocity;  ///< by body; accelerations of motion from rest, slip of any size
  std::vector<Eigen::Vector3d> force;  ///< by point
  int programmes = 0;                  ///< cone programmes
  int iterations = 0;                  ///< of these; sweeps of motion from rest
};

/// Largest velocity over what the body's own loads would do. Bodies with hardly any loads are measured by a share of the
/// largest load: others move them. @param load by body. @return 0 without loads
[[nodiscard]] double largest_motion(const std::vector<BodyVelocity>& velocity,
                                    const std::vector<BodyVelocity>& load);

/// @param program with the strengths of its points. @param dilation tan(psi) by point, 0 to mu. @param load F, by body
/// @param force to start from, by point; empty: none
[[nodiscard]] ReleasedMotion motion_from_rest(const ConeProgram& program, const std::vector<double>& dilation,
                                              const std::vector<BodyVelocity>& load,
                                              std::vector<Eigen::Vector3d> force);

/// @param load F, by body: forces within the strengths have to balance it. @param start slip to start from, by body
/// @param margin growth above -margin counts as a motion: a share of the factor that is looked for
[[nodiscard]] ReleasedMotion slow_slip(ConeProgram& program, const std::vector<double>& dilation,
                                       const std::vector<BodyVelocity>& load,
                                       const std::vector<BodyVelocity>& start, double margin);

/// Accelerations of a motion that slow slip has found: it is followed until inertia takes its part.
/// @param slip velocities of any size
[[nodiscard]] ReleasedMotion motion_of_slip(ConeProgram& program, const std::vector<double>& dilation,
                                            const std::vector<BodyVelocity>& load,
                                            const std::vector<BodyVelocity>& slip);

}  // namespace ashlar

// Motion of rigid blocks whose joints obey Coulomb's law. Friction |t| <= c + mu N opposes the slip. A sliding joint
// opens by its dilation angle psi only, while the associated flow of a cone programme opens it by mu.
//
// Such motion is not unique, and equilibrium may exist beside it. Two methods find it:
//   motion from rest  The accelerations at one instant. Each point in turn gets the force by Coulomb's law while
//     the others keep theirs (block Gauss-Seidel; Jourdan, Alart and Jean, Comput. Methods Appl. Mech. Eng. 155
//     (1998) 31). It converges to a motion, or to rest. Which one of several solutions is found depends on the
//     initial forces.
//   slow slip         Motion so slow that forces stay in balance. With the shift s = (mu - tan psi) |v_t| of each
//     point the programme `slow` (cone_program.hpp) maps one slip to the next one. The map is homogeneous: slip grows
//     or decays by a factor, and the factor 1 is the limit (de Saxce and Feng, Math. Comput. Model. 28 (1998) 225,
//     for the shift).
// Slow slip finds a gradual onset of motion. Motion from rest finds an onset with finite acceleration, which slow
// slip misses.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "solver/limit/cone_program.hpp"

namespace ashlar {

enum class LimitOutcome {
  stands,   ///< nothing moves
  moves,    ///< a motion was found
  unknown,  ///< the iteration did not converge
};

struct ReleasedMotion {
  LimitOutcome outcome = LimitOutcome::unknown;
  std::vector<BodyVelocity> velocity;  ///< by body; accelerations of motion from rest, slip of arbitrary
                                       ///< scale
  std::vector<Eigen::Vector3d> force;  ///< by point
  int programmes = 0;                  ///< cone programmes
  int iterations = 0;                  ///< of these; sweeps of motion from rest
};

/// Largest velocity relative to that due to the body's own loads. Bodies with very small loads are compared with a
/// share of the largest load, as others move them. @param load by body. @param bodies the first ones, which are compared.
/// @return 0 without loads
[[nodiscard]] double largest_motion(const std::vector<BodyVelocity>& velocity,
                                    const std::vector<BodyVelocity>& load,
                                    std::size_t bodies = std::numeric_limits<std::size_t>::max());

/// @param program with the strengths of its points. @param dilation tan(psi) by point, 0 to mu. @param load F, by body
/// @param force initial one, by point; empty: zero
[[nodiscard]] ReleasedMotion motion_from_rest(const ConeProgram& program, const std::vector<double>& dilation,
                                              const std::vector<BodyVelocity>& load,
                                              std::vector<Eigen::Vector3d> force);

/// @param load F, by body: forces within the strengths must balance it. @param start initial slip, by body
/// @param margin growth above -margin counts as a motion: a share of the factor searched
[[nodiscard]] ReleasedMotion slow_slip(ConeProgram& program, const std::vector<double>& dilation,
                                       const std::vector<BodyVelocity>& load,
                                       const std::vector<BodyVelocity>& start, double margin);

/// Accelerations of a motion found by slow slip, which is followed until inertia becomes relevant.
/// @param slip velocities of arbitrary scale
[[nodiscard]] ReleasedMotion motion_of_slip(ConeProgram& program, const std::vector<double>& dilation,
                                            const std::vector<BodyVelocity>& load,
                                            const std::vector<BodyVelocity>& slip);

}  // namespace ashlar

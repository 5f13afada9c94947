// The equation one time step solves for the changes D of a block's unknowns, for every integrator:
//
//   w (F_external - F_elastic) + F_contact - rho m (D - D_free) = 0
//
// w: weight of the smooth forces, m: effective inertia, D_free: change without forces. Mass damping -alpha M v is
// linear in D and included in m and D_free. F_external and F_elastic are evaluated after the share `end_share` of the
// step. With v, a at the start and v', a' at the end of a step of length dt:
//
// Newmark family (dda: beta 1/2, gamma 1, alpha_m = alpha_f = 0; generalized-alpha: Chung and Hulbert 1993)
//   D  = dt v + dt^2 (1/2 - beta) a + beta dt^2 A         A the whole end acceleration,
//   v' = v + dt (1 - gamma) a + gamma dt A                 A = a' + F_contact / (gamma M)
//   (1 - alpha_m) M a' + alpha_m M a = F_external - F_elastic - alpha M v_f,
//   v_f = (1 - alpha_f) v' + alpha_f v,   so that  w = gamma/(1 - alpha_m).
// Only smooth forces enter the acceleration carried to the next step. The impulse of a contact is exactly dt
// F_contact with F_contact at the end of the step, as in the dda step. A jump of the contact force therefore leaves
// no oscillation, and momentum is exchanged exactly.
// The dda step multiplies an oscillation with W = w dt by (1 + W^2/2)^(-1/2) as long as W <= 4. Stiffer oscillations
// are damped less again: x' = 2 (x + dt v)/(2 + W^2), dt v' = 2 (x' - x) - dt v has the determinant 2/(2 + W^2) and
// the trace (4 - W^2)/(2 + W^2). Beyond W = 4 one eigenvalue is real and tends to -1 as 1 - 8/W^2: motion that is far
// too stiff for the step remains as a velocity that changes sign in each step.
// Damping by stiffness, beta s, adds to F_elastic, where that is evaluated,
//   k (F_elastic - R F_start),   k = beta / (end_share dt),
// with F_start at the start of the step and R the rotation of the block since then: beta K times the mean velocity of
// deformation up to that time. It does not resist rotation. Its error is of first order in dt with generalized-alpha
// and dda, of second order with average-acceleration.
// Dashpots of quiet faces add -C v_d to F_external - F_elastic; they are no part of m and D_free. v_d is v' with dda, the
// mean velocity D/dt with the others: with generalized-alpha v_f of a block at rest on contacts is not zero, as A is
// that of smooth forces and contacts, and a that of smooth forces alone.
// average-acceleration: D = dt (v + v')/2, M (v' - v)/dt = F - alpha M D/dt.
// Static: rho m D is the inertia of a block released from rest, in a step of length sqrt(2/m).
#pragma once

#include "solver/settings.hpp"

namespace ashlar {

/// Steps of a motion, and iterations of a static analysis, in which blocks are released from rest.
enum class StepKind { motion, statics };

/// Coefficients of D, v and a in a quantity linear in them.
struct StepCombination {
  double change = 0.0;        ///< of D
  double velocity = 0.0;      ///< of v
  double acceleration = 0.0;  ///< of a

  /// @param d,v,a arrays of one shape: of coefficients or of unknowns
  template <class Matrix>
  [[nodiscard]] Matrix operator()(const Matrix& d, const Matrix& v, const Matrix& a) const {
    Matrix sum = change * d + velocity * v;
    if (acceleration != 0.0) sum += acceleration * a;
    return sum;
  }
};

/// One step's scheme; see the head of this file for the symbols.
struct TimeScheme {
  double step = 0.0;          ///< dt, s
  double end_share = 1.0;     ///< time within the step at which smooth forces are evaluated: 0 its start, 1
                              ///< its end
  double force_weight = 1.0;  ///< w
  double inertia = 0.0;       ///< m, 1/s^2
  StepKind kind = StepKind::motion;
  bool impulsive = false;  ///< changes are velocities times dt at the end of a step
  bool mean_contacts =
      false;                  ///< contact forces are means over the step (MeanResponse), not those at its end
  double mass_damping = 0.0;  ///< alpha, 1/s
  double stiffness_share = 0.0;      ///< k of the damping by stiffness
  StepCombination free_change;       ///< D_free, without D
  StepCombination end_velocity;      ///< v'
  StepCombination damped_velocity;   ///< v_f: the damping force is -alpha M v_f
  StepCombination dashpot_velocity;  ///< v_d: the force of dashpots is -C v_d
  double acceleration_memory = 0.0;  ///< alpha_m

  [[nodiscard]] bool is_static() const { return kind == StepKind::statics; }

  /// F_external. @param force of a time (s), (p, 3). @param start,end of the step, s
  template <class Force>
  [[nodiscard]] auto smooth_force(const Force& force, double start, double end) const {
    auto result = force(end);
    if (end_share < 1.0) result = end_share * result + (1.0 - end_share) * force(start);
    return result;
  }
  /// a' from the acceleration by smooth forces and damping.
  template <class Matrix>
  [[nodiscard]] Matrix end_acceleration(const Matrix& smooth, const Matrix& a) const {
    return (smooth - acceleration_memory * a) / (1.0 - acceleration_memory);
  }
};

/// The scheme of a dynamic step of length `step` > 0.
[[nodiscard]] TimeScheme time_scheme(const SimulationSettings& settings, double step);

}  // namespace ashlar

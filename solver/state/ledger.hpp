// The energy ledger of a run (theory.md section 9). The positive terms add up to the energy input:
//   kinetic + elastic + gravity + contact + friction + damping + numerical - applied - redetection_energy
//     = constant + residual.
//
// Refound: contacts are re-detected in each step. The energy of a pair's springs may then differ from that at the end
// of the step before, because polygons, quadrature points, feet or the kind of a contact have changed. This energy is
// gained or lost without work of any force. Springs that would gain energy get deeper rest gaps (spring_energy.hpp),
// so that gains are within rounding error, except for bonds under tension. The loss is an error of the method,
// measured exactly for each pair and step. Multipliers store no energy: the energy they dissipate is numerical. The
// energy they release to a pair of blocks beyond that is gained.
#pragma once

namespace ashlar {

/// Energies at the end of a step, J. Those from friction on add up over the run.
struct Ledger {
  double kinetic = 0.0;
  double elastic = 0.0;
  double gravity = 0.0;  ///< -m g . x; 0 if gravity has a history
  double contact = 0.0;  ///< stored in normal and shear springs
  double friction =
      0.0;               ///< dissipated by sliding and by fracture of bonds so far, less the work of dilation
  double damping = 0.0;  ///< dissipated by damping of mass, stiffness, joints and quiet faces, and by impacts
                         ///< with a coefficient of restitution so far
  double applied = 0.0;  ///< work of loads, moving supports, and gravity with a history, so far
  double numerical = 0.0;           ///< dissipated by the time integrator so far
  double redetection_gained = 0.0;  ///< gained by springs of re-detected contacts so far, >= 0
  double redetection_lost = 0.0;    ///< lost by springs of re-detected contacts so far, >= 0
  double residual = 0.0;            ///< error of the energy balance so far: residual forces, rounding

  [[nodiscard]] double redetection_energy() const { return redetection_gained - redetection_lost; }

  /// The conserved sum, without the residual.
  [[nodiscard]] double balance() const {
    return kinetic + elastic + gravity + contact + friction + damping + numerical - applied -
           redetection_energy();
  }
};

}  // namespace ashlar

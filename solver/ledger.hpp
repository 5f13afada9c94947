// The energy ledger of a run (theory.md section 9). Positive terms add up to what was put in:
//   kinetic + elastic + gravity + contact + friction + damping + numerical - applied = constant + residual.
#pragma once

namespace ashlar {

/// Energies at the end of a step, J. Those from friction on add up over the run.
struct Ledger {
  double kinetic = 0.0;
  double elastic = 0.0;
  double gravity = 0.0;    ///< -m g . x
  double contact = 0.0;    ///< stored in normal and shear springs
  double friction = 0.0;   ///< dissipated by sliding so far
  double damping = 0.0;    ///< taken by mass damping so far
  double applied = 0.0;    ///< work of loads so far
  double numerical = 0.0;  ///< taken by the time integrator so far
  double residual =
      0.0;  ///< what the balance lacks so far: unsolved forces, contacts re-found at another place

  /// The sum that stays constant, without the residual.
  [[nodiscard]] double balance() const {
    return kinetic + elastic + gravity + contact + friction + damping + numerical - applied;
  }
};

}  // namespace ashlar

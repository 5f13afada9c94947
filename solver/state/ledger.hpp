// The energy ledger of a run (theory.md section 9). Positive terms add up to what was put in:
//   kinetic + elastic + gravity + contact + friction + damping + numerical - applied - refound
//     = constant + residual.
//
// Refound: each step finds its contacts anew. Where the springs of a pair then hold another energy than at
// the end of the step before, because polygons, quadrature points, feet or the kind of a contact changed,
// that much energy has come in or gone without any force doing work. Springs that would hold more are taken
// to be at rest deeper (spring_energy.hpp), so that nothing but rounding is gained, bonds under tension
// apart. What is lost is an error of the method, measured exactly for each pair and step. Multipliers store
// nothing: what they take is numerical, and what they give a pair of blocks beyond what they took from it is
// gained.
#pragma once

namespace ashlar {

/// Energies at the end of a step, J. Those from friction on add up over the run.
struct Ledger {
  double kinetic = 0.0;
  double elastic = 0.0;
  double gravity = 0.0;         ///< -m g . x; 0 if gravity has a history
  double contact = 0.0;         ///< stored in normal and shear springs
  double friction = 0.0;        ///< dissipated by sliding so far, less what dilation gave back
  double damping = 0.0;         ///< taken by damping of mass, of stiffness and of joints so far
  double applied = 0.0;         ///< work of loads, supports that move, and gravity that has a history, so far
  double numerical = 0.0;       ///< taken by the time integrator so far
  double refound_gained = 0.0;  ///< came into springs where contacts were found anew, so far, >= 0
  double refound_lost = 0.0;    ///< went out of springs so, so far, >= 0
  double residual = 0.0;        ///< what the balance lacks so far: forces not balanced, rounding

  [[nodiscard]] double refound() const { return refound_gained - refound_lost; }

  /// The sum that stays constant, without the residual.
  [[nodiscard]] double balance() const {
    return kinetic + elastic + gravity + contact + friction + damping + numerical - applied - refound();
  }
};

}  // namespace ashlar

// Damage of a bond with fracture energy (notes/fracture_energy.md): traction falls linearly with opening and slip once
// the strength is reached, in place of a sudden drop. The law is one of traction and opening of a joint: it has no
// width, so that its energy does not depend on the size of blocks.
//
// With T, c the strengths (Pa), G_I, G_II the energies (J/m^2), kn, ks the stiffnesses (Pa/m), g the opening, p the
// permanent slip, D the damage, 0 to 1:
//     tension     t(D) = T (1 - D)  at the opening  w(D) = w0 + D (wf - w0),   w0 = T/kn,  wf = 2 G_I/T
//     unloading   along the secant  t = K(D) g,   K(D) = T (1 - D)/w(D),  K(0) = kn
//     shear       c(D) = c (1 - D),  D grows by dp/pf,   pf = 2 G_II/c;   slip p is permanent, ks (s - p) elastic
// Opening to g > w(D) sets D to (g - w0)/(wf - w0). One D for both: an open crack has no cohesion left.
//
// Energy: the triangle (0, 0), (w0, T), (wf, 0) has the area T wf/2 = G_I, of which T wf dD/2 is dissipated by a growth
// of D: elastic energy at the strength is a part of G_I, so that the whole does not depend on kn. In shear the
// dissipation is the integral of c (1 - p/pf) dp = c pf/2 = G_II beside that of friction; what springs held at the
// strength is released on the way. Both need  kn > T^2/(2 G_I)  and  ks > c^2/(2 G_II): softer springs hold more than
// the fracture energy, and the traction would jump.
#pragma once

namespace ashlar {

/// Fracture energies of a joint, J/m^2, >= 0; 0: its strength is lost at once.
struct FractureEnergy {
  double tension = 0.0;  ///< G_I
  double shear = 0.0;    ///< G_II

  [[nodiscard]] bool given() const { return tension > 0.0 || shear > 0.0; }
  friend bool operator==(const FractureEnergy&, const FractureEnergy&) = default;
};

/// Smallest stiffness of the springs of a bond, Pa/m: they hold no more than its fracture energy.
/// @param strength Pa, >= 0. @param energy J/m^2, > 0
[[nodiscard]] constexpr double least_bond_stiffness(double strength, double energy) {
  return strength * strength / (2.0 * energy);
}

/// Stiffness of automatic springs over the smallest one: the strength is reached at a tenth of the final opening.
inline constexpr double automatic_bond_stiffness = 10.0;

/// The bond of one point, and its damage at the start of a step.
struct BondDamage {
  double tension = 0.0;      ///< T A, N; 0: no tensile strength
  double cohesion = 0.0;     ///< c A, N; 0: no cohesion
  double peak = 0.0;         ///< w0, m
  double end_opening = 0.0;  ///< wf, m, > w0 if T > 0
  double end_slip = 0.0;     ///< pf, m, > c/ks if c > 0
  double start = 0.0;        ///< D at the start of the step

  /// True if the strength of the point falls gradually.
  [[nodiscard]] bool softens() const { return tension > 0.0 || cohesion > 0.0; }
  /// w(D), m.
  [[nodiscard]] double opening(double damage) const { return peak + damage * (end_opening - peak); }
  /// K(D), N/m; 0 without tensile strength.
  [[nodiscard]] double stiffness(double damage) const {
    return tension > 0.0 ? tension * (1.0 - damage) / opening(damage) : 0.0;
  }
  /// D of an opening under loading, at least `damage`.
  [[nodiscard]] double at_opening(double gap, double damage) const {
    if (!(tension > 0.0) || !(gap > opening(damage))) return damage;
    return gap < end_opening ? (gap - peak) / (end_opening - peak) : 1.0;
  }
  /// Energy dissipated in tension by a growth of D on the envelope, J.
  [[nodiscard]] double energy_of_tension(double growth) const { return 0.5 * tension * end_opening * growth; }
};

}  // namespace ashlar

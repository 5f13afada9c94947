// Material of a block.
#pragma once

namespace ashlar {

/// Relation of stress and deformation (theory.md section 4).
enum class Elasticity {
  linear,              ///< Hooke's law in a frame that turns with the block: small strains and bending
  st_venant_kirchhoff  ///< Hooke's law between Green strain and second Piola-Kirchhoff stress: large bending
};

/// Isotropic elastic rock. Valid: density > 0, young_modulus > 0, 0 <= poisson_ratio < 0.5.
struct Material {
  double density = 0.0;        ///< kg/m^3
  double young_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.0;  ///< 1
  Elasticity elasticity = Elasticity::linear;

  /// First Lame constant, Pa.
  [[nodiscard]] double lame_lambda() const {
    return young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
  }
  /// Second Lame constant (shear modulus), Pa.
  [[nodiscard]] double lame_mu() const { return young_modulus / (2.0 * (1.0 + poisson_ratio)); }
};

}  // namespace ashlar

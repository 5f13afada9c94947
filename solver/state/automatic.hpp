// Numbers a scene may leave to the program ("auto"), chosen from the blocks.
#pragma once

#include "mechanics/block/block_model.hpp"

namespace ashlar {

/// Where automatic choices come from. Each is a ratio without unit.
struct AutomaticRatios {
  /// kn of area springs times block size over Young's modulus: larger is stiffer and nearer to no
  /// penetration, but harder for the open-close iteration. 20: a joint gives way as much as a twentieth of
  /// the block.
  double normal_stiffness = 20.0;
  double shear_to_normal_stiffness = 0.5;
  /// Stiffness of tied joints times block size over Young's modulus: a joint gives way a hundred thousandth
  /// of what the block does; stiffer costs digits.
  double tie_stiffness = 1e5;
  double distance = 1e-3;  ///< of the smallest block's size
  double angle_degrees = 10.0;
  double chord_tolerance = 5e-3;        ///< of the smallest block's size
  double penetration_tolerance = 1e-3;  ///< of the contact distance
};

/// Cube root of the volume, m.
[[nodiscard]] double block_size(const BlockModel& block);

/// What of a block an automatic stiffness depends on.
struct StiffnessSource {
  double size = 0.0;           ///< block_size, m
  double young_modulus = 0.0;  ///< Pa; of no use if fixed
  bool fixed = false;
  // What the compiler writes here compares with a literal 0, which the check takes for a pointer.
  [[nodiscard]] auto operator<=>(const StiffnessSource&) const = default;  // NOLINT(modernize-use-nullptr)
};
[[nodiscard]] StiffnessSource stiffness_source(const BlockModel& block);

/// Normal stiffness between two blocks from the softer material and the smaller size: Pa/m, or for point
/// springs N/m (the area stiffness times the smaller size squared).
[[nodiscard]] double automatic_normal_stiffness(const StiffnessSource& a, const StiffnessSource& b,
                                                bool area_springs, const AutomaticRatios& ratios = {});

/// Stiffness of a tied joint from the stiffer material and the smaller size, Pa/m.
[[nodiscard]] double automatic_tie_stiffness(const BlockModel& a, const BlockModel& b,
                                             const AutomaticRatios& ratios = {});

}  // namespace ashlar

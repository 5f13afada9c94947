// Extreme parameters of a scene: order, place, shape, masses, stiffness, size and step.
#pragma once

#include <vector>

#include "apps/program/study/study.hpp"

namespace ashlar {

/// Blocks at rest on a floor, with one parameter of the scene after the other taken to extremes, and all others as
/// for a cube of 1 m of rock (2500 kg/m^3, 1e9 Pa). With Poisson's ratio 0 the answer is known for every order: at
/// the top of a block of height h under a pressure q the displacement is
///     u = -(q h + rho g h^2 / 2) / E
/// relative to its bottom, which is by (q + rho g h) / kn below the floor on springs, and on the floor with
/// multipliers.
/// The time step is varied with a block that slides from 3 m/s to rest over the distance v^2 / (2 mu g).
///
/// Columns: sweep (0 order, 1 offset from the origin in block sizes, 2 slab: width over height, 3 bar lying:
/// length over height, 4 upper over lower density of two blocks, 5 Young's modulus in Pa, 6 size in m, 7 time
/// step in s), value, order, contact (0 springs, 1 multipliers), error (relative, of the displacement of the top or
/// the sliding distance), condition (of the block's elastic stiffness without rigid motions), iterations (of the
/// static analysis, or steps), rejected steps, ended (1: as required), promised (required upper bound of the error;
/// infinity: none).
[[nodiscard]] StudyResult study_stability();

/// Extent of a study of stability.
struct StabilityRange {
  std::vector<int> orders;  ///< of all sweeps except the first
  int most_order;           ///< of the first
  double least_step;        ///< s, of the last
};

/// The same within a range: study_stability() uses orders 1, 2 and 4, up to 12, and steps down to 2.5e-5 s.
[[nodiscard]] StudyResult study_stability_of(const StabilityRange& range);

}  // namespace ashlar

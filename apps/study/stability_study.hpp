// How far from the ordinary a scene may be: order, place, shape, masses, stiffness, size and step.
#pragma once

#include <vector>

#include "apps/study/study.hpp"

namespace ashlar {

/// Blocks at rest on a floor, one number of the scene after the other taken far from the ordinary, everything
/// else as in a cube of 1 m of stone (2500 kg/m^3, 1e9 Pa). With Poisson's ratio 0 the answer is known for
/// every order: at the top of a block of height h that bears a pressure q
///     u = -(q h + rho g h^2 / 2) / E  more than at its bottom,
/// which is by (q + rho g h) / kn below the floor on springs, and on the floor with multipliers.
/// The time step is varied with a block that slides to rest from 3 m/s, v^2 / (2 mu g) on.
///
/// Columns: sweep (0 order, 1 offset from the origin in block sizes, 2 slab: width over height, 3 bar lying:
/// length over height, 4 upper over lower density of two blocks, 5 Young's modulus in Pa, 6 size in m, 7 time
/// step in s), value, order, contact (0 springs, 1 multipliers), error (relative, of the displacement of the
/// top or the distance slid), condition (of the block's elastic stiffness, rigid motions apart), iterations
/// (of the static analysis, or steps), rejected steps, ended (1: as it should), promised (what the error is
/// promised to be below; infinity: nothing is).
[[nodiscard]] StudyResult study_stability();

/// How far a study of stability goes.
struct StabilityRange {
  std::vector<int> orders;  ///< of all sweeps but the first
  int most_order;           ///< of the first
  double least_step;        ///< s, of the last
};

/// The same within a range: study_stability() takes orders 1, 2 and 4, up to 12, and steps from 2.5e-5 s on.
[[nodiscard]] StudyResult study_stability_of(const StabilityRange& range);

}  // namespace ashlar

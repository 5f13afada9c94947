// Error of contact against run time, for the options of a user.
#pragma once

#include "apps/program/study/study.hpp"

namespace ashlar {

/// Extent of the study; the tests run less of it.
struct ContactStudySize {
  int patch_levels = 2;  ///< sub-face levels of the patch test, from 0
  bool hertz = true;
  double reference_step = 5e-5;  ///< s, of the falling block used as reference
  double finest_step = 2.5e-4;   ///< s, of the other runs; they start from 2e-3 and are halved, with the
                                 ///< paper's settings once less
  int falling_levels = 2;        ///< sub-face levels of the falling block, from 0
};

/// Three problems, by sub-faces, springs (per area, per point), surface (curved, flat), kn and time step:
///   1 the contact patch (patch_test.hpp), error of the jump over p/kn: exact;
///   2 Hertz's sphere (hertz_sphere.hpp), largest error of radius, approach and peak pressure: his formulas;
///   3 the falling block (falling_block.hpp), deepest place of the tip, compared with a run of the total formulation
///     with area springs on the curved surface and steps of reference_step. The reference is from the same program: it
///     shows differences between settings, not from nature.
/// The paper's own settings, incremental formulation, point springs and flat sub-faces, are a curve of problems 1 and
/// 3.
/// Columns: problem, curve (in the order of the picture), incremental, point springs and flat surface as 0 or 1,
/// levels (of sub-faces; for Hertz's sphere its facets along a side), kn, time step (0: static), error, seconds.
[[nodiscard]] StudyResult study_contact();
[[nodiscard]] StudyResult study_contact(const ContactStudySize& size);

}  // namespace ashlar

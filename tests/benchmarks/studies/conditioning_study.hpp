// Loss of digits by the choice of the basis (theory.md section 2).
#pragma once

#include "apps/program/study/study.hpp"

namespace ashlar {

/// The cantilever 8 x 3 x 1 under its own weight at 0, 10 and 1000 half-widths from the origin, n = 1 to 8, with the
/// monomials of the paper (global, centred, scaled) and the orthonormal basis. By basis (0 global, 1 centred, 2
/// scaled, 3 orthonormal), distance and order: condition of the mass matrix and of the clamped stiffness, and number
/// of lost digits of the tip deflection out of sixteen (16: none is correct).
[[nodiscard]] StudyResult study_conditioning();

/// The same with orders up to a given one.
[[nodiscard]] StudyResult study_conditioning_to(int most_order);

}  // namespace ashlar

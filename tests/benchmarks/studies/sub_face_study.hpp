// Distance of sub-faces from the curved block, and its certified bound (theory.md section 6.2).
#pragma once

#include "apps/program/study/study.hpp"

namespace ashlar {

/// A block 8 x 3 x 1 bent to a circular arc and twisted, as far as a polynomial of order n = 2 to 8 allows, divided
/// to decreasing chord tolerances. By order and tolerance: sub-faces, largest sampled chord error, its certified
/// bound, their ratio, smallest ratio of all sub-faces, seconds.
[[nodiscard]] StudyResult study_sub_faces();

}  // namespace ashlar

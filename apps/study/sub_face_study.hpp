// How far sub-faces are off the curved block, and what is known about it for certain (theory.md section 6.2).
#pragma once

#include "apps/study/study.hpp"

namespace ashlar {

/// A block 8 x 3 x 1 that is bent to a circular arc and twisted, as far as a polynomial of order n = 2 to 8
/// can, divided to ever smaller chord tolerances. By order and tolerance: sub-faces, largest sampled chord
/// error, its certified bound, their ratio, least ratio of all sub-faces, seconds.
[[nodiscard]] StudyResult study_sub_faces();

}  // namespace ashlar

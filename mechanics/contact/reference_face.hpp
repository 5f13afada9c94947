// Which of two blocks in contact is the master: the one on whose surface feet and normals are taken
// (theory.md section 6.4).
//
// Two faces that lie on each other may be tilted against each other by the contact angle. Where one of them
// ends at the deep end of their overlap, its rim is what touches, and it moves along the other face: with
// its own normal it would go into the other by the tangent of the tilt times the way it slides, or lift off.
#pragma once

#include <functional>
#include <vector>

#include "mechanics/contact/contact_points.hpp"

namespace ashlar {

/// A place on the rim of a face, where another block lies on it.
struct RimPlace {
  bool of_a;        ///< whose rim it is
  int face;         ///< of the other block, which lies on the rim
  Vector3 place;    ///< m
  Vector3 outward;  ///< unit, along the faces, away from the one with the rim
  double near;      ///< m, largest gap there of a block that goes on
};

/// Tells whether a third block goes on behind a rim, near to what lies on the rim and not turning away from
/// it, so that the rim is none to it.
using SurfaceContinues = std::function<bool(const RimPlace&)>;

/// Whether block a is the master in each of the overlaps: for all overlaps of two faces, the block whose face
/// does not end at their deep end: its surface turns away from the other one there, and nothing goes on
/// behind it. Rims of both, or of none, and gaps that vary by no more than rounding (outline_tolerance) do
/// not tell; then fixed blocks are before others, undivided surfaces before divided ones, and larger volumes
/// before what is smaller by more than rounding.
/// @param otherwise whether a is the master of equal blocks: nothing in the pair tells
/// @return (#overlaps)
[[nodiscard]] std::vector<bool> reference_is_on_a(const ContactBody& a, const ContactBody& b,
                                                  const std::vector<CellOverlap>& overlaps,
                                                  const SurfaceContinues& goes_on, bool otherwise = false);

}  // namespace ashlar

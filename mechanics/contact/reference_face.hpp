// Choice of the reference face of two blocks in contact, on whose surface feet and normals are evaluated (theory.md
// section 6.4).
//
// Two faces in contact may be tilted against each other by up to the contact angle. If one of them ends at the deep
// end of their overlap, its edge touches and moves along the other face. With its own normal it would penetrate the
// other face by the slip times the tangent of the tilt, or lift off.
#pragma once

#include <functional>
#include <vector>

#include "mechanics/contact/contact_points.hpp"

namespace ashlar {

/// A place on the edge of a face on which another block lies.
struct RimPlace {
  bool of_a;        ///< true: the edge belongs to a
  int face;         ///< face of the other block, which lies on the edge
  Vector3 place;    ///< m
  Vector3 outward;  ///< unit, along the faces, away from the one with the edge
  double near;      ///< m, largest gap there of a continuing block
};

/// True if a third block continues the surface beyond an edge, close to the block on the edge and not turning away
/// from it, so that the edge does not act as an edge.
using SurfaceContinues = std::function<bool(const RimPlace&)>;

/// By overlap, true if the reference face is on block a. For all overlaps of two faces it is on the block whose face
/// does not end at their deep end: where a face ends, its surface turns away from the other one and no block
/// continues it. Edges of both or of none, and gaps that vary within rounding error (outline_tolerance), do not
/// decide. Then fixed blocks precede others, undivided surfaces precede divided ones, and larger volumes precede
/// those smaller by more than rounding.
/// @param otherwise true if a has the reference face of equal blocks: nothing in the pair decides
/// @return (#overlaps)
[[nodiscard]] std::vector<bool> reference_is_on_a(const ContactBody& a, const ContactBody& b,
                                                  const std::vector<CellOverlap>& overlaps,
                                                  const SurfaceContinues& continues, bool otherwise = false);

}  // namespace ashlar

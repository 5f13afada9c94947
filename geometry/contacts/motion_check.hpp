// Whether two surfaces pass through each other within a step (theory.md section 6): every vertex of one
// against every cell of the other, every edge against every edge, all points on straight lines from start to
// end of the step.
//
// Conservative: the distance of two features divided by the fastest approach of their points is time in which
// they cannot touch; advancing by it again and again ends at a time before the first touch, or at the end of
// the step. A touch counts when the features can be beyond each other afterwards: their signed volume, a
// cubic in time, is bounded by its Bernstein coefficients. Edges that start along each other, or meet where
// one of them ends, are left to their ends.
#pragma once

#include <variant>
#include <vector>

#include "geometry/contacts/contact_search.hpp"
#include "geometry/contacts/moving_features.hpp"

namespace ashlar {

/// Two features that would pass through each other.
struct Touch {
  double share;  ///< of the step, 0 to 1: no touch before
  /// The two as a contact, with the normal at the touch and the gap at the start of the step along it.
  std::variant<VertexContact, EdgeContact> contact;
};

/// What counts as passing, and what is taken care of.
struct MotionLimits {
  double
      tolerance;  ///< m, > 0: deeper than this at the end of the step, nearer than a quarter of it: a touch
  double reach;   ///< m: a known contact stands for features around its place up to this distance
};

/// All touches that none of the known contacts stands for: a contact does for features that share its faces
/// (or, on the side of a cell, faces next to it) and are near it.
/// @param known contacts of a and b that the step takes into account
[[nodiscard]] std::vector<Touch> find_touches(const MovingSurface& a, const MovingSurface& b,
                                              const PairContacts& known, const MotionLimits& limits);

}  // namespace ashlar

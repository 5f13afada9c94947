// Continuous collision check of two surfaces within a step (theory.md section 6): every vertex of one against every
// cell of the other, every edge against every edge, with all points on straight lines from start to end of the step.
//
// Conservative advancement: within the distance of two features divided by the fastest approach of their points they
// cannot touch. Repeated advancement ends at a time before the first touch, or at the end of the step. A touch counts
// if the features can be beyond each other afterwards: their signed volume, a cubic in time, is bounded by its
// Bernstein coefficients. Edges that start collinear, or meet at an end of one of them, are treated by their ends.
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

/// Limits of the collision check.
struct MotionLimits {
  double
      tolerance;  ///< m, > 0: a touch is deeper than this at the end of the step, and closer than a quarter
                  ///< of it before
  double reach;   ///< m: a known contact represents features around its place up to this distance
};

/// All touches not represented by a known contact: a contact represents nearby features that share its faces (or, on
/// the side of a cell, adjacent faces).
/// @param known contacts of a and b included in the step
[[nodiscard]] std::vector<Touch> find_touches(const MovingSurface& a, const MovingSurface& b,
                                              const PairContacts& known, const MotionLimits& limits);

}  // namespace ashlar

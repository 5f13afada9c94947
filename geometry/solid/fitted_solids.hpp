// Solids that were surveyed: neighbours that were meant to share a face overlap or gape by what the survey is
// known to, and faces with four corners are bent. Fitting puts such faces on common planes.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// What a survey is known to, and what is made of it.
struct FitLimits {
  double fit;        ///< m, > 0: how far corners may be off the plane of their face
  double farthest;   ///< m: a corner that would have to move farther is at no place that planes agree on
  double same_way;   ///< cosine: faces of one solid look the same way, those of neighbours at each other
  double dependent;  ///< of the largest singular value: normals depend on each other but for this
  double rounding;   ///< of the largest coordinate: what moves less has only been rounded
};

/// What fit_solids did.
struct SolidFit {
  std::size_t planes = 0;   ///< that faces of several solids were put on
  std::size_t solids = 0;   ///< that were changed
  std::size_t corners = 0;  ///< that were moved
  double farthest = 0.0;    ///< m, the longest way of a corner
};

/// Puts faces of neighbours onto common planes, in place. Faces belong together if all their corners lie
/// within `limits.fit` of the plane that fits them best (least squares): adjacent faces of one solid that look
/// the same way, and faces of two solids that look at each other and whose boxes, grown by fit, meet. Each corner
/// then goes to the nearest point of the planes of its faces. Corners that this moves by rounding only, and
/// solids that share no plane with another one, stay as they are, to the bit. Where four or more planes that
/// have no common point meet in a corner it comes as near to them as it can, and faces stay bent there.
/// @param solids empty ones are passed over
/// @throws std::invalid_argument "what is wrong (value), what is allowed" if a corner would have to move by
/// more than the farthest (faces at a sharp angle), or a solid is none any more; solids are then undefined
SolidFit fit_solids(std::vector<std::optional<Polyhedron>>& solids, const FitLimits& limits);

}  // namespace ashlar

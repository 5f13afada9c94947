// Do two solids have common inner points near a common point of their boundaries?
//
// Near an inner point of a feature a solid is a cone T (solid_features.hpp): half of space at a face, a wedge
// at an edge, any polyhedral cone at a corner. The solids cross near a common point iff their cones have
// common inner points. Where one of them is half of space, or both are wedges, signs tell. A corner on an
// edge or on a corner: the boundaries of the cones either have a common ray, then other pairs of features
// meet there and tell; or they have none, then each lies inside or outside the other cone as a whole, and one
// ray of it decides.
#pragma once

#include "geometry/any_solid/solid_features.hpp"

namespace ashlar {

/// @param f,g features whose relative interiors have a common point.
/// @return true only if the solids cross near that point. For a corner on an edge or on a corner, false may
/// leave it to other pairs of features that share it.
[[nodiscard]] bool cross_at(const SolidFeatures& a, const ContactFeature& f, const SolidFeatures& b,
                            const ContactFeature& g, PredicateLadder& ladder);

}  // namespace ashlar

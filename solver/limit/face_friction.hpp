// Place of friction in the overlap of two faces of rigid blocks, whose pressure is known by its resultant only.
//
// Corner forces can represent every resultant of a pressure over the overlap. Friction mu N in a corner at the
// distance r from the centroid resists twisting about the normal by mu N r. Uniform pressure resists it by mu N R
// only, with
//
//   R = 1/A  integral |x - c| dA           c: centroid of the overlap
//
// R is 0.3826 a for a square of side a, whose corners are 0.7071 a from its centroid. So friction acts at c + R /
// r_max (x_i - c): no distribution of normal forces over the corners resists twisting by more than uniform pressure.
// Resistance to translation and to tilting about an edge, which move all points of a face in its plane alike or not
// at all, is unchanged (notes/limit_analysis.md).
#pragma once

#include <array>
#include <map>
#include <vector>

#include "geometry/contacts/cell_overlap.hpp"
#include "mechanics/contact/contact_kinematics.hpp"

namespace ashlar {

/// Place of a contact point, m: midway between both blocks.
[[nodiscard]] Vector3 middle_of_point(const ContactPoint& point);

/// 1/A integral |x - about| dA over convex polygons, m. @param polygons counter-clockwise, at least one with an area
[[nodiscard]] double mean_distance(const std::vector<std::vector<Eigen::Vector2d>>& polygons,
                                   const Eigen::Vector2d& about);

/// Friction of the overlap of two faces: at the share of the distance of its pressure from the middle.
struct FaceFriction {
  Vector3 middle;  ///< m, c
  double share;    ///< R / r_max
};

/// By faces of both blocks, of the overlaps with corners among the points.
/// @param overlaps of the cells of both blocks. @param points of the pair
[[nodiscard]] std::map<std::array<int, 2>, FaceFriction> face_frictions(
    const PlacedSurface& a, const PlacedSurface& b, const std::vector<CellOverlap>& overlaps,
    const std::vector<ContactPoint>& points);

/// Place of friction of each point, m: as above for the corners of the overlap of two faces, for all other points
/// their place.
[[nodiscard]] std::vector<Vector3> places_of_friction(
    const std::map<std::array<int, 2>, FaceFriction>& frictions, const std::vector<ContactPoint>& points);

}  // namespace ashlar

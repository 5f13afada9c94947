// Where friction acts in the overlap of two faces of rigid blocks, whose pressure is known by its resultant only.
//
// Corner forces have every resultant that pressure over the overlap can have, and friction mu N in a corner at the distance r
// from the middle resists twisting about the normal by mu N r. Uniform pressure resists it by mu N R only, with
//
//   R = 1/A  integral |x - c| dA           c: centroid of the overlap
//
// 0.3826 a of a square of side a, whose corners are 0.7071 a from the middle. So friction acts at  c + R / r_max (x_i - c):
// no distribution of normal forces over the corners resists twisting by more than uniform pressure. Sliding in one direction
// and tilting about an edge, which move a face in its plane all alike or not at all, stay as they are
// (notes/limit_analysis.md).
#pragma once

#include <vector>

#include "geometry/contacts/cell_overlap.hpp"
#include "mechanics/contact/contact_kinematics.hpp"

namespace ashlar {

/// A contact point as a place, m: half way between both blocks.
[[nodiscard]] Vector3 middle_of_point(const ContactPoint& point);

/// 1/A integral |x - about| dA over convex polygons, m. @param polygons counter-clockwise, at least one with an area
[[nodiscard]] double mean_distance(const std::vector<std::vector<Eigen::Vector2d>>& polygons,
                                   const Eigen::Vector2d& about);

/// Where friction of each point acts, m: of the corners of two faces' overlap as above, of all other points where they are.
/// @param overlaps of the cells of both blocks. @param points of the pair
[[nodiscard]] std::vector<Vector3> places_of_friction(const PlacedSurface& a, const PlacedSurface& b,
                                                      const std::vector<CellOverlap>& overlaps,
                                                      const std::vector<ContactPoint>& points);

}  // namespace ashlar

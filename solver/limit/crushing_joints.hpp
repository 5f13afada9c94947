// Joints that crush: pressure between two rigid faces is at most the compressive strength f, with friction under it.
//
// With v(x) the relative velocity of the faces, which is affine, a joint dissipates
//     integral h(v(x)) dA,   h(v) = max over |t| <= c + mu N, -T <= N <= f  of  -p . v                  (strength)
// and h is convex. Triangles bound it from both sides:
//     A h(v(centroid))  <=  integral over a triangle of h(v) dA  <=  A/3 sum of h(v(corner))               (bounds)
// The left side is a point with the strength of the triangle at its centroid: uniform stress on the triangle, which
// forces of the joint can be. The right side is a point at each corner with a third of the strength: no forces of the
// joint are outside of these. So a model with points at centroids stands only where the joints stand, and one with
// points at corners moves only where they move. Both are exact for triangles in which h is linear: where the joint is
// open, or crushes, or slides in one direction. Other triangles are divided, for the velocities of the mechanism that
// the weaker model has and the stronger one has not.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "solver/limit/rigid_model.hpp"

namespace ashlar {

/// True for points of joints with a compressive strength.
[[nodiscard]] bool crushes(const RigidPoint& point);

/// True if any joint has parts.
[[nodiscard]] bool has_parts(const RigidModel& model);

/// Replaces the points of chosen joints that overlap by parts of their overlaps, with pressure at centroids. Joints
/// without an overlap keep their points, which have no area and do not crush.
/// @param chosen called for points without bars
void divide_joints(RigidModel& model, const std::function<bool(const RigidPoint&)>& chosen);

/// A model with the pressure of parts at their corners.
struct CornerModel {
  RigidModel model;
  /// By point of the divided model: its points here, thrice the same if it is no part.
  std::vector<std::array<std::size_t, 3>> corners;
  std::vector<std::size_t> source;  ///< by point here: a point of the divided model of the same joint
};
[[nodiscard]] CornerModel corner_model(const RigidModel& divided);

/// By point of the divided model: its velocities at corners, normal first.
using CornerVelocities = std::vector<std::array<Eigen::Vector3d, 3>>;
/// @param program of the corner model. @param velocity by body of the programme
[[nodiscard]] CornerVelocities corner_velocities(const CornerModel& corners, const ConeProgram& program,
                                                 const std::vector<BodyVelocity>& velocity);

/// h(v) of a strength.
[[nodiscard]] double dissipation(const ConeStrength& strength, const Eigen::Vector3d& velocity);

/// Differences of both sides of (bounds), summed. @param strength by point of the divided model
[[nodiscard]] double bound_difference(const RigidModel& divided, const std::vector<ConeStrength>& strength,
                                      const CornerVelocities& velocity);

/// Divides parts until the differences of (bounds) have decreased to a tenth, or there are many.
/// @return by new point, the point that it is a part of; empty: nothing to divide
[[nodiscard]] std::vector<std::size_t> refine_parts(RigidModel& divided,
                                                    const std::vector<ConeStrength>& strength,
                                                    const CornerVelocities& velocity);

/// Strengths of the points of a programme.
[[nodiscard]] std::vector<ConeStrength> strengths_of(const ConeProgram& program);

}  // namespace ashlar

// A support that gives way along one coordinate: how its places move, and the cone programme of what stands on it and
// beside it.
//
// Without a direction the support moves away from the structure at right angles to gravity: from the middle of gravity
// of all that may move to the middle of its contacts. A support that lies around the structure spreads, each place away
// from that middle.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/statics/rigid_model.hpp"

namespace ashlar {

/// Blocks that do not move and that one presses on which does, in ascending order.
[[nodiscard]] std::vector<int> supports_of(const RigidModel& model);

/// Middle of gravity of all that may move, m. @pre there is a body
[[nodiscard]] Vector3 middle_of_bodies(const RigidModel& model);

/// The part of a vector at right angles to gravity. @param down any length; zero: all of it
[[nodiscard]] Vector3 level_part(const Vector3& vector, const Vector3& down);

/// The level direction in which a support on one side of the structure moves away from it, of length 1.
/// @return empty: the support lies around the structure, or below its middle
[[nodiscard]] std::optional<Vector3> direction_away(const RigidModel& model, int support,
                                                    const Vector3& down);

/// Of the support at a point that it has with a body, in m per m of the coordinate.
using SupportVelocity = std::function<Vector3(const RigidPoint& point)>;

/// The programme of a model with one more body behind the others, of one coordinate: the support that moves.
/// @param threads >= 1
[[nodiscard]] ConeProgram program_with_support(const RigidModel& model, int support,
                                               const SupportVelocity& velocity, int threads);

/// The load on the support's coordinate is lowered (sign 1) or raised (sign -1) as far as balance allows: the load is
/// -sign times the factor of the answer, and the support moves by `sign` in the motion that is dual to it.
[[nodiscard]] ConeQuestion question_of_support(const RigidModel& model, double sign);

/// The load has no bound: what stands at the support can be pressed as much as one likes.
[[nodiscard]] bool boundless(const ConeQuestion& question, const ConeAnswer& answer);

/// Forces in balance were found.
[[nodiscard]] bool is_balanced(const ConeAnswer& answer);

/// N, by point of the model, on its first block.
[[nodiscard]] std::vector<Vector3> forces_of(const RigidModel& model, const ConeAnswer& answer);

}  // namespace ashlar

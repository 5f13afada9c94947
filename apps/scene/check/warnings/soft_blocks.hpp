// Implausible stiffnesses of materials and joints: so soft that the scene's own forces cause large strains or
// penetrations. They are valid input, but usually a wrong unit (5 for 5 GPa).
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/expanded_scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Largest strain, or penetration relative to a block's size, without a warning. It is about the limit of validity of
/// linear elasticity and of contact at small penetrations.
inline constexpr double largest_ordinary_strain = 0.1;

/// Warns of each material whose Young's modulus E would allow a larger strain of a block, for the most strained
/// block, by the largest of
///   its own weight      density |gravity| height / E,  height along gravity; for a history, its largest value
///   a load              |traction| / E or |force| / (size^2 E),  at its largest factor,  size^3 = volume
///   impact              (|velocity| + |angular_velocity| radius) / sqrt(E / density),  radius half the
///                       diagonal of the block's box; sqrt(E / density) is the speed of sound
/// and of each given normal stiffness for which a block would penetrate its support by more than that part of its
/// size under its own weight, with contact over a whole face (area springs) or at three points (point springs).
/// Automatic stiffnesses are proportional to E. Fixed blocks and weightless scenes at rest cause no warning.
/// @param solids one per scene.block; missing ones are ignored
void warn_of_soft_blocks(const ExpandedScene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                         Diagnostics& diagnostics);

}  // namespace ashlar

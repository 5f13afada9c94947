// Materials and joints that hardly can be meant: so soft that the scene's own forces press blocks flat or
// into each other. They are good input, but mostly a wrong unit (5 for 5 GPa).
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Strains, and penetrations in parts of a block's size, that are no reason for a warning. Linear elasticity
/// and contact at small penetrations mean something up to about here.
inline constexpr double largest_ordinary_strain = 0.1;

/// Warns of each material at whose Young's modulus E a block would be strained by more than that, the most
/// strained block named, by the largest of
///   its own weight      density |gravity| height / E,  height along gravity; of a history, where it is largest
///   a load              |traction| / E or |force| / (size^2 E),  at its largest factor,  size^3 = volume
///   meeting something   (|velocity| + |angular_velocity| radius) / sqrt(E / density),  radius half the
///                       diagonal of the block's box; sqrt(E / density) is the speed of sound
/// and of each normal stiffness given at which a block would sink by more than that part of its size into
/// what bears its own weight on a whole face (area springs) or on three points (point springs). Automatic
/// stiffnesses grow with E. Fixed blocks and weightless scenes at rest give no reason to warn.
/// @param solids one per scene.block; those that are missing are passed over
void warn_of_soft_blocks(const Scene& scene, const std::vector<std::optional<Polyhedron>>& solids,
                         Diagnostics& diagnostics);

}  // namespace ashlar

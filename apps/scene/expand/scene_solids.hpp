// The solids of a scene: each block's shape in its own coordinates, placed by scale, rotate, translate.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/preparation.hpp"
#include "apps/scene/model/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Resolution of given coordinates, m: they may have been rotated before, in double precision with some operations,
/// by the author of the scene.
[[nodiscard]] double resolution_of(const std::vector<Vector3>& points);

/// The same of a placed block, m: of hulls and meshes in the user's coordinates, which they were rounded to.
[[nodiscard]] double resolution_of(const SceneBlock& block, const Polyhedron& placed);

/// Builds and places the shape of every block, in the scene's order. Faces are merged before placing if they are
/// exactly flat; for meshes and hulls also if they are flat to 2^-46 of the largest coordinate (1.4e-14), so that a
/// rotated box still has six. Without rotate a box keeps its exact corners (plus translate); rotations by multiples
/// of 90 degrees about a coordinate axis have an exact matrix. A shape that bounds no solid is reported at its key, a
/// mesh with its file and the faulty elements, and leaves an empty entry. Equal shapes are built once.
/// @param shapes if given, (#blocks): each solid before translation, shared by equal ones; null if the solid is empty
[[nodiscard]] std::vector<std::optional<Polyhedron>> build_solids(
    const Scene& scene, Diagnostics& diagnostics,
    std::vector<std::shared_ptr<const Polyhedron>>* shapes = nullptr, Preparation* preparation = nullptr);

}  // namespace ashlar

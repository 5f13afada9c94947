// The solids of a scene: each block's shape built in its own coordinates and placed by scale, rotate,
// translate.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/scene/diagnostics.hpp"
#include "apps/scene/preparation.hpp"
#include "apps/scene/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// What given coordinates are known to, m: they may have been turned before, in double precision and some
/// operations, by whoever wrote them.
[[nodiscard]] double resolution_of(const std::vector<Vector3>& points);

/// Builds and places the shape of every block, in the scene's order. Faces are merged before placing: where
/// they are exactly flat, of meshes and hulls also where they are flat to 2^-46 of the largest coordinate
/// (1.4e-14), so that a rotated box still has six. Without rotate a box keeps exactly its corners (plus
/// translate); turns by multiples of 90 degrees about a coordinate axis have an exact rotation matrix. A
/// shape that bounds no solid is reported at its key, a mesh with its file and the faulty elements, and
/// leaves an empty entry. Equal shapes are built once.
/// @param shapes if given, (#blocks): each solid as it was before translate, shared by equal ones; null where
/// the solid is empty
[[nodiscard]] std::vector<std::optional<Polyhedron>> build_solids(
    const Scene& scene, Diagnostics& diagnostics,
    std::vector<std::shared_ptr<const Polyhedron>>* shapes = nullptr, Preparation* preparation = nullptr);

}  // namespace ashlar

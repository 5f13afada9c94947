// Layers of the ground beside a model, found along a plane in which it ends: for free-field boundaries.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/model/scene.hpp"
#include "geometry/solid/polyhedron.hpp"

namespace ashlar {

/// Index into scene.boundary of the quiet boundary below a side, at right angles to it: the first with a wave, or the
/// first at all. Empty: there is none.
[[nodiscard]] std::optional<std::size_t> base_of_side(const Scene& scene, std::size_t side);

/// Part of a column beside the faces in a plane.
struct SideLayer {
  double bottom = 0.0;    ///< m, above the plane of the base
  double top = 0.0;       ///< m
  std::size_t block = 0;  ///< one with a face there: its material and order
};

/// Layers from the base up, each on the one before.
struct SideLayers {
  std::vector<SideLayer> layers;
  std::string fault;  ///< reason why there are none; empty: there are
};

/// Layers beside the faces of moving and present blocks in the plane of a side, between the heights at which any of
/// them begins or ends. Of several faces at a height the largest counts.
/// @param side,base indices into scene.boundary. @param solids by block; null: not built
[[nodiscard]] SideLayers layers_beside(const Scene& scene, std::size_t side, std::size_t base,
                                       const std::vector<const Polyhedron*>& solids);

}  // namespace ashlar

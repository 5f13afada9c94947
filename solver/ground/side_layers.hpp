// Layers of the ground beside a model, found along a plane in which it ends: those of a free-field column.
#pragma once

#include <optional>
#include <vector>

#include "mechanics/supports/face_selection.hpp"
#include "solver/ground/ground_block.hpp"

namespace ashlar {

/// Part of a column beside the faces in a plane.
struct SideLayer {
  double bottom = 0.0;    ///< m, above the plane of the base
  double top = 0.0;       ///< m
  std::size_t block = 0;  ///< one with a face there: its material and order
};

/// Reason why there is no column.
struct SideLayersFault {
  enum class Kind {
    no_face,     ///< no block has a face in the plane of the side
    above_base,  ///< the lowest face begins at the height `bottom`: the base belongs below it
    too_low,     ///< no face is higher than `bottom`, within which heights of the largest block are one
    gap,         ///< no face is between the heights `bottom` and `top`
  };
  Kind kind = Kind::no_face;
  double bottom = 0.0;  ///< m, above the plane of the base
  double top = 0.0;     ///< m
};

/// Layers from the base up, each on the one before.
struct SideLayers {
  std::vector<SideLayer> layers;
  std::optional<SideLayersFault> fault;  ///< empty: there are layers
};

/// Layers beside the faces of moving and present blocks in the plane of a side, between the heights at which any of
/// them begins or ends. Of several faces at a height the largest counts.
/// @param side its normal points out of the model. @param base at right angles to it, below the model
/// @throws std::invalid_argument as faces_in_plane
[[nodiscard]] SideLayers layers_beside(const Plane& side, const Plane& base,
                                       const std::vector<GroundBlock>& blocks);

}  // namespace ashlar

// Positions of a scene relative to the origin of the model, Scene::origin, which lies near its blocks: coordinates of a
// survey, 5 300 000 m from their own origin, have lost half of the digits that contact needs after one product. Readers
// read positions as the user gave them; they are moved once, before anything is made of them, and back for JSON, so that
// results differ from those at the user's origin by the rounding of the given coordinates alone.
//
// This file is the register of positions: every key of a scene with a position is here or, for masonry, in its reader.
// Files of frames and tables get the origin back where they are written (ResultFolder, Measure::origin, Run::motions).
#pragma once

#include <vector>

#include "apps/scene/model/scene.hpp"
#include "geometry/boxes/box.hpp"

namespace ashlar {

/// The origin for a model inside a box, m: in each direction zero where the centre is nearer to the user's origin than 8
/// times the largest side, otherwise the centre, rounded to a power of two times an integer. The difference of a
/// coordinate near the model and the origin is exact.
/// @param box empty: zero
[[nodiscard]] Vector3 origin_for(const Box& box);

/// From positions as read to positions of the model: subtracts scene.origin, and from each block's shape its
/// shape_origin. Formulas of x, y and z keep the user's coordinates.
void move_to_model(Scene& scene);

/// The inverse of move_to_model, for JSON; exact where that was exact. Formulas must not be evaluated then.
void move_to_user(Scene& scene);

}  // namespace ashlar

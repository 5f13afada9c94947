// Reads the formulation of a scene, which determines some keys of [contact].
#pragma once

#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Sets the keys of [contact] that the formulation determines: "incremental" and "paper" have flat sub-faces, "paper" has
/// point springs. Reports such a key that was given with another value.
/// @param scene whose analysis and [contact] have been read
void imply_contact(Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

// Water of a scene as loads of its blocks, from its [[water]] (solver/ground/water_pressure.hpp).
#pragma once

#include "apps/scene/assemble/scene_loading.hpp"
#include "solver/ground/water_pressure.hpp"

namespace ashlar {

/// Pressure on the blocks of a scene, and in their joints, by indices of scene.block. Does not need the scene any more.
/// @param diagnostics receives levels that are not known over a wet face
[[nodiscard]] WaterPressure water_pressure_of(const LoadedScene& loaded, Diagnostics& diagnostics);

}  // namespace ashlar

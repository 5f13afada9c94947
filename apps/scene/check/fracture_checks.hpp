// Checks of fracture energies and of ties that break: what a gradual loss of strength needs, and what it excludes.
#pragma once

#include <string>

#include "apps/scene/model/diagnostics.hpp"
#include "apps/scene/model/scene.hpp"

namespace ashlar {

/// Reports a fracture energy without its strength, a strength without fracture energy, springs that hold more than it,
/// and keys that it excludes.
/// @param law as the table at `path` leaves it
void check_fracture(const Scene& scene, const SceneJointLaw& law, const std::string& path,
                    Diagnostics& diagnostics);

/// The same for a [[joint]] that gives any key of it, and a tie beside strengths of its own.
void check_joint_fracture(const Scene& scene, std::size_t joint, Diagnostics& diagnostics);

}  // namespace ashlar

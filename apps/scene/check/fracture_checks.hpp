// Checks of fracture energies, of ties that break and of bonded cuts: what a gradual loss of strength needs, and what
// it excludes.
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

/// The law of [contact] with the keys of one joint, and below these, if it names a bonded cut, with those of the bond.
[[nodiscard]] SceneJointLaw law_with_joint(const Scene& scene, std::size_t joint);

/// Reports a [[joint]] with `tied`, and a glued cut, that match two blocks bonded by a cut.
void check_bonded_blocks(const Scene& scene, Diagnostics& diagnostics);

}  // namespace ashlar

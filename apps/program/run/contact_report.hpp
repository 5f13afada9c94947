// Report on the contacts of two blocks: those that a step uses, and those that it removes, each with the reason.
#pragma once

#include <optional>
#include <string>

#include "apps/scene/model/diagnostics.hpp"
#include "solver/contact/pair_history.hpp"

namespace ashlar {

class Simulation;

/// The two blocks of an option "--explain-contacts A,B". Names may have commas.
/// @return empty if no two different blocks have these names, which is reported
[[nodiscard]] std::optional<PairKey> pair_by_names(const std::string& names, const Simulation& simulation,
                                                   Diagnostics& diagnostics);

/// Report on the explanation of the present contacts (solver, run/contact_explanation.hpp) and the forces of the last
/// step, in complete lines. Faces are numbered from 0, as in the block's mesh.
/// @param origin Scene::origin, of places
[[nodiscard]] std::string contact_report(const Simulation& simulation, const PairKey& blocks,
                                         const Vector3& origin = Vector3::Zero());

}  // namespace ashlar

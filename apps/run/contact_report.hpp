// Contacts of two blocks in words: those that a step uses, and those that it leaves out, each with the reason.
#pragma once

#include <optional>
#include <string>

#include "apps/scene/diagnostics.hpp"
#include "solver/contact/pair_history.hpp"

namespace ashlar {

class Simulation;

/// The two blocks of an option "--explain-contacts A,B". Names may have commas.
/// @return empty: no two different blocks have these names, which is told
[[nodiscard]] std::optional<PairKey> pair_by_names(const std::string& names, const Simulation& simulation,
                                                   Diagnostics& diagnostics);

/// What run/contact_explanation.hpp (solver) finds of the present state, and the forces of the last step. Lines with an
/// end each. Faces are numbered from 0, as in the block's mesh
[[nodiscard]] std::string contact_report(const Simulation& simulation, const PairKey& blocks);

}  // namespace ashlar

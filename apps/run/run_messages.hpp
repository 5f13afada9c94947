// Messages of `ashlar run`: automatic values, end of a run and its reason, warnings about results.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "apps/run/run.hpp"
#include "apps/scene/assemble/build_simulation.hpp"

namespace ashlar {

/// Prints automatic values, and blocks that initial_state left as placed.
void tell_choices(const BuiltSimulation& built, std::ostream& err);

/// Prints how a run ended, nothing for a completed one; its largest displacement and stresses, and failed joints; and
/// warnings: strains beyond those of linear elasticity, sub-faces too coarse for curved faces in contact, blocks that
/// penetrate deeper than rigid contact would allow, friction that differed from Coulomb's law, dilating joints that slid
/// without contact, orders too low for their blocks. @param quiet only errors, interrupts and warnings
void tell_results(const Run& run, const std::filesystem::path& folder, bool quiet, std::ostream& err);

}  // namespace ashlar

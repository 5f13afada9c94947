// Rigid polyhedra of LMGC90: BODIES.DAT and, beside it, BULK_BEHAV.DAT, TACT_BEHAV.DAT, DRV_DOF.DAT and DOF.INI, as
// far as they are there.
//
// Bodies are numbered in their order. Read: polyhedra (POLYR) and boxes (PLANx, by their half lengths) of RBDY3 bodies, densities (Umas), gravity, friction
// of the laws between colours, bodies held by six zero velocities, constant forces. Blocks are called COLOUR_NUMBER after
// the colour of their contactor and the number of the body, so that joints name colours. Of velocities that are not
// zero the body is held, of forces that change in time the last value is taken; both are listed. Clusters of several
// contactors in a body, other contactors and deformable bodies are refused.
#pragma once

#include <filesystem>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

/// @param bodies the file BODIES.DAT. @throws ImportError with file, line and column
[[nodiscard]] ImportedModel read_lmgc90(const std::filesystem::path& bodies);

}  // namespace ashlar

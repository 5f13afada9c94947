// Materials and contact laws of a model of LMGC90: BULK_BEHAV.DAT and TACT_BEHAV.DAT.
#pragma once

#include <map>
#include <string>

#include "apps/scene/import/imported_model.hpp"

namespace ashlar {

/// Gravity, and the densities (Umas) of materials by their names in the file. @throws ImportError
void read_lmgc90_bulk(const std::string& file, std::string_view text,
                      const std::map<std::string, std::size_t>& materials, ImportedModel& model);

/// Friction between colours. Of the last law that is given for two colours; static friction where a law has two. Other
/// parts of a law (restitution, cohesion) are left out and listed. Colours without a law do not touch in LMGC90; here they
/// touch without friction, which a note says.
/// @param colours of the blocks, and the number of blocks of each. @throws ImportError
void read_lmgc90_contact(const std::string& file, std::string_view text,
                         const std::map<std::string, int>& colours, ImportedModel& model);

}  // namespace ashlar

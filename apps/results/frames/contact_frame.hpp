// The contact points of a state: contacts.pvd.
#pragma once

#include "apps/results/frames/vtu/vtu_writer.hpp"
#include "solver/run/simulation.hpp"

namespace ashlar {

/// All contact points of the last step: gap, force and normal on the first block, area, type, state
/// (contact_state.hpp) and both blocks.
[[nodiscard]] UnstructuredGrid contact_frame(const Simulation& simulation);

}  // namespace ashlar

// The bolts of an accepted step: forces, memories and energies that the run keeps.
#pragma once

#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Energies of the bolts of a step that a process owns, J.
struct BoltEnergies {
  double work = 0.0;        ///< on all blocks
  double held = 0.0;        ///< stored at the end
  double gained = 0.0;      ///< stored at the end less at the start
  double dissipated = 0.0;  ///< by yielding in this step; in statics what is no longer counts negative
};

/// Stores forces and memories, and books work on moving supports and what the bolts store more or less at the start of
/// the step than at the end of the last one. Memories of a static analysis stay those of the start of the load level:
/// the path of its iterations is none of a bar (notes/static_friction.md).
[[nodiscard]] BoltEnergies take_over_bolts(const BlockSystem& system, RunState& state,
                                           const StepProblem& problem);
/// Lets evaluations start from the last state: at the start of a load level and of motion.
void commit_bolts(RunState& state);
/// Breaks bars that have reached their rupture strain in a static analysis. With several processes collective.
/// @return true if there are any in the run
bool rupture_bolts(const BlockSystem& system, RunState& state);

/// Installs bolts of the run in the present state that have no memory yet. With several processes collective; each block
/// along a bolt has to be a neighbour of the others' owners. @return energy that those of this process store, J
double install_bolts(const BlockSystem& system, RunState& state);

}  // namespace ashlar

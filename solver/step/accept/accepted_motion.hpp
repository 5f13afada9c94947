// Motion of the blocks in an accepted step, with its energies.
#pragma once

#include "solver/step/step_problem.hpp"

namespace ashlar {

/// Work on potentials and what these gained, J.
struct PotentialSum {
  double work = 0.0;
  double change = 0.0;
};

/// Moves all blocks to the end of a solved problem and books the energies of inertia, loads and damping. Free blocks
/// get back the spin that the integrator has removed (angular_momentum.hpp). With several processes collective. @return sum over elastic energies
[[nodiscard]] PotentialSum move_blocks(const BlockSystem& system, RunState& state,
                                       const StepProblem& problem);

}  // namespace ashlar

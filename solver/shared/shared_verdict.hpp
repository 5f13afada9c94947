// The verdict of limit analysis (rigid_verdict.hpp) on a static analysis that several ranks share.
//
// The first rank makes the rigid model of all blocks, from their models and the positions that the others send, and
// tells its answer to all: one small problem, at the end of the analysis (notes/ranks.md has its size).
#pragma once

#include "solver/shared/ghosts.hpp"
#include "solver/statics/static_analysis.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// As rigid_verdict(), or of an analysis that goes on as rigid_collapse(), for the blocks of this rank. Collective.
/// @param run with ranks
/// @return the same on all ranks
[[nodiscard]] StaticStatus shared_verdict(const RunContext& run, double end_time, StaticStatus status);

/// Verdict on an iteration of a static analysis of any number of ranks: that of rigid blocks where it ended without a
/// result, in equilibrium, or moving with doubts (motion_doubt.hpp); otherwise the status. Collective.
[[nodiscard]] StaticStatus judged(const RunContext& run, double end_time, StaticStatus status);

}  // namespace ashlar

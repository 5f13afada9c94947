// The verdict of limit analysis on a static analysis that has ended (limit_analysis.hpp). One without an answer stands or
// moves. One in equilibrium moves if that needs forces that only wedging could have put there.
//
// It speaks where rigid blocks tell: joints keep their strength when they slide, loads do not change on the way, no
// support moves, and nothing was in equilibrium before under other loads, of which forces may be left. Where loads have
// changed, it says of an analysis without an answer whether they are beyond what any forces balance, or at that limit.
#pragma once

#include "solver/statics/static_analysis.hpp"
#include "solver/step/run_context.hpp"

namespace ashlar {

/// Takes note of the motion that limit analysis finds, so that moving_blocks() tells it.
/// @param status equilibrium or not_converged. @return moving, or the same status
[[nodiscard]] StaticStatus rigid_verdict(const RunContext& run, double end_time, StaticStatus status);

}  // namespace ashlar

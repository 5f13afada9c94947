// Ranks as threads of one process: for tests of everything that ranks share, without MPI.
#pragma once

#include <functional>

#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// Runs a program on ranks, each a thread of its own. If it throws on one of them, collective functions of the others
/// throw OtherRankFailed. @param count > 0. @param program called once on each rank
/// @throws the exception of the lowest rank that did not just hear of another one
void run_on_threads(int count, const std::function<void(Ranks&)>& program);

}  // namespace ashlar

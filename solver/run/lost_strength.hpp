// Contact points whose joint has lost its strength, for results.
#pragma once

#include <vector>

#include "mechanics/contact/joint_law.hpp"
#include "solver/contact/pair_history.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// By point of a pair: 1 if its joint had strength that fails and the nearest point that the pair remembers has failed,
/// else 0.
[[nodiscard]] std::vector<char> points_without_strength(const JointLaw& law, const PairHistory& history,
                                                        const PairRecord& record);

}  // namespace ashlar

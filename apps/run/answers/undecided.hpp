// Factors of limit analysis between which a static analysis without a result lies.
#pragma once

#include <functional>
#include <string>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// Factor of safety of rigid blocks where the present load level began, under its loads and strengths: "rigid blocks have a
/// factor of safety of 0.93 without the stresses of earlier states (block a slides), and of 1.3 with the most favourable
/// ones". Strengths of all joints are divided.
/// @param simulation whose static analysis has no result. @param may_continue called before each trial; false ends the search
/// @return empty: limit analysis does not apply (a shared run, joints that lose strength, incremental blocks, bolts that break),
/// the search was ended, or it has no result either
[[nodiscard]] std::string undecided_factors(const Simulation& simulation, double end_time, int threads,
                                            const std::function<bool()>& may_continue);

}  // namespace ashlar

// Strength that the joints of contact points have lost, for results.
#pragma once

#include <vector>

#include "mechanics/contact/laws/joint_law.hpp"
#include "solver/contact/pair_history.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {

/// By point of a pair: 1 if its joint had strength that fails and the nearest point that the pair remembers has failed,
/// else 0.
[[nodiscard]] std::vector<char> points_without_strength(const JointLaw& law, const PairHistory& history,
                                                        const PairRecord& record);

/// Fracture energy that a remembered point has dissipated, J/m^2: that of tension where it has failed or is open, else that of
/// shear, by its damage.
[[nodiscard]] double dissipated_energy(const FractureEnergy& fracture, const PointMemory& memory);

/// By point of a pair: dissipated_energy() of the nearest point that the pair remembers, of a joint that had strength.
[[nodiscard]] std::vector<double> dissipated_energies(const JointLaw& law, const PairHistory& history,
                                                      const PairRecord& record);

}  // namespace ashlar

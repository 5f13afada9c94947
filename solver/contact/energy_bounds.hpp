// Energy bounds of re-detected springs (mechanics/contact/laws/spring_energy.hpp): their energy at the end of the last
// step plus the energy lost by other re-detected springs at the same block. A block that slides from one block to the
// next so transfers the energy of its springs.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "solver/contact/contact_pair.hpp"
#include "solver/contact/pair_history.hpp"

namespace ashlar {

/// Energy that the springs of a pair have lost, J.
struct EnergyLoss {
  PairKey blocks;
  double energy;              ///< > 0
  std::array<bool, 2> moves;  ///< of the blocks: springs at one that moves can take it over
};

/// Energy that the springs of a pair need beyond their own at the end of the last step, J, > 0.
struct EnergyClaim {
  PairKey blocks;
  double lacking;
};

/// In the order of blocks.
struct EnergyTransfers {
  std::vector<EnergyLoss> losses;
  std::vector<EnergyClaim> claims;
};

/// Which pairs a process speaks for, and the transfers of all processes from those of each.
struct EnergyExchange {
  std::function<bool(const PairKey&)> owns;
  std::function<EnergyTransfers(const EnergyTransfers&)> gather;
};

/// @param pairs as re-detected, unloaded at the surface. @param histories of the pairs at the end of the last step
/// @param moving blocks that can transfer spring energy; springs between other blocks are not detected again
/// @param exchange null: there are no other pairs
/// @return bounds for ContactPair::hold_at_most, one for each pair: with them, all normal springs together hold at
/// most their energy at the end of the last step
[[nodiscard]] std::vector<SpringEnergy> energy_bounds(const std::vector<ContactPair>& pairs,
                                                      const PairHistories& histories,
                                                      const std::vector<bool>& moving,
                                                      const EnergyExchange* exchange = nullptr);

}  // namespace ashlar

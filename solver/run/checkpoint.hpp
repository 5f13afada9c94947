// All that a simulation has beyond its scene: stored and given to a simulation built from the same scene, it
// lets the run go on bit for bit as if it had never stopped.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "solver/run/simulation.hpp"

namespace ashlar {

/// What one pair of blocks remembers (ContactMemory).
struct RememberedPair {
  std::array<int, 2> blocks;
  std::vector<ContactMemory::Entry> entries;
  std::vector<PressureCut> cuts;
  double deepest;  ///< m
  double bulge;    ///< m
  SpringEnergy held;
};

/// Everything that a step depends on or reports; see the members of Simulation for meaning and units. What
/// follows from the scene and kept factorisations are left out: those are made anew with the same values.
struct SimulationSnapshot {
  StepClock clock;
  double next_step = 0.0;
  int steps = 0;
  bool remembers_statics = false;
  std::vector<BlockState> states;
  std::map<int, CarriedShape> carried;  ///< of incremental blocks
  std::vector<Eigen::MatrixX3d> accelerations;
  std::vector<double> spin_debts;
  std::vector<RememberedPair> memory;
  std::map<std::array<int, 2>, double> contact_work;
  ContactAccounts taken;
  FinderState finder;
  StepReport report;
  std::vector<PairRecord> records;
  Ledger ledger;
  StaticState statics;
  double start_balance = 0.0;
  double largest_step_residual = 0.0;
  double largest_energy = 0.0;
  double largest_penetration = 0.0;
  DeepestPoint deepest;
  FrictionTally sliding_friction;
  std::map<std::array<int, 2>, double> true_depths;
  std::vector<Rejection> rejections;
  SimulationCounts counts;
  PhaseSeconds seconds;
};

[[nodiscard]] std::string to_bytes(const SimulationSnapshot& snapshot);

/// @throws std::runtime_error if the bytes are not those of a snapshot.
[[nodiscard]] SimulationSnapshot snapshot_from_bytes(std::string_view bytes);

}  // namespace ashlar

#include "fuzz/seeds.hpp"

#include <stdexcept>
#include <utility>

#include "solver/run/checkpoint.hpp"
#include "support/simulations.hpp"

namespace ashlar::fuzz {
namespace {

/// Two cubes on a fixed base, the upper one of another order, after some steps.
std::string stored_stack(bool multipliers, int order) {
  const Material soft{2000.0, 1e7, 0.2};
  std::vector<BlockModel> blocks;
  blocks.emplace_back(test_support::fixed_box({-1, -1, -1}, {2, 2, 0}));
  blocks.emplace_back(test_support::block_of("low", Polyhedron(make_box({0, 0, 0}, {1, 1, 1})), soft, 1));
  blocks.emplace_back(
      test_support::block_of("high", Polyhedron(make_box({0.2, 0.1, 1}, {1.2, 1.1, 2})), soft, order));
  const JointLaw law{1e9, 1e9, 0.6, 1e3, 1e3, true};
  SimulationSettings settings;
  settings.time_step = 1e-3;
  settings.augmented = multipliers;
  const std::vector<InitialMotion> motion(blocks.size());
  Simulation simulation(std::move(blocks), motion, test_support::same_law(law), settings);
  if (!test_support::run_until(simulation, 5e-3)) throw std::logic_error("a seed's steps are taken");
  return to_bytes(simulation.snapshot());
}

}  // namespace

std::vector<std::string> stored_states() {
  return {stored_stack(false, 1), stored_stack(false, 2), stored_stack(true, 1)};
}

}  // namespace ashlar::fuzz

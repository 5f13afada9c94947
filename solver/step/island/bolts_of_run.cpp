#include "solver/step/island/bolts_of_run.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/bolts/bolted_blocks.hpp"
#include "solver/state/agreement.hpp"

namespace ashlar {

std::vector<ToldBolt> own_bolts(const BlockSystem& system, const RunState& state) {
  std::vector<ToldBolt> own;
  for (std::size_t k = 0; k < state.bolts.size(); ++k)
    if (owns_bolt(system, k)) own.push_back({static_cast<int>(k), state.bolts[k]});
  return own;
}

void take_told(std::vector<ToldBolt> told, RunState& state) {
  for (ToldBolt& one : told) state.bolts.at(at(one.bolt)) = std::move(one.state);
}

bool knows_bolt(const BlockSystem& system, std::size_t bolt) {
  if (system.exchange().alone()) return true;
  const std::vector<int> blocks = present_blocks(system.bolts()[bolt].chain);
  return owns_bolt(system, bolt) || std::any_of(blocks.begin(), blocks.end(), [&](int block) {
           return system.owns(block) && !system.blocks()[at(block)].fixed();
         });
}

bool owns_bolt(const BlockSystem& system, std::size_t bolt) {
  if (system.exchange().alone()) return true;
  const std::vector<int> blocks = present_blocks(system.bolts()[bolt].chain);
  if (blocks.empty()) return system.exchange().first();
  // A process without any of them does not know which are fixed.
  if (std::none_of(blocks.begin(), blocks.end(), [&](int block) { return system.owns(block); })) return false;
  const auto lowest = std::find_if(blocks.begin(), blocks.end(),
                                   [&](int block) { return !system.blocks()[at(block)].fixed(); });
  return system.owns(lowest == blocks.end() ? blocks.front() : *lowest);
}

std::vector<StepBolt> bolts_of_step(const BlockSystem& system, const RunState& state) {
  if (system.bolts().empty()) return {};
  std::vector<bool> moving = system.moving();
  for (int k = 0; k < system.count(); ++k) moving[at(k)] = moving[at(k)] && system.owns(k);
  return step_bolts(system.bolts(), state.bolts, system.blocks(), state.states, moving);
}

int moving_block(const BlockSystem& system, const StepBolt& bolt) {
  return *std::find_if(bolt.blocks().begin(), bolt.blocks().end(),
                       [&](int block) { return system.moving()[at(block)]; });
}

void tell_bolts(const BlockSystem& system, RunState& state) {
  if (system.exchange().alone() || system.bolts().empty()) return;
  take_told(joined_of_run(system, own_bolts(system, state)), state);
}

}  // namespace ashlar

#include "solver/shared/shared_bolts.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/bolts/bolted_blocks.hpp"
#include "solver/ranks/block_share.hpp"

namespace ashlar {
namespace {

/// A bolt in the message of its owner.
struct ToldBolt {
  int bolt = -1;
  BoltState state;
};

bool is_shared(const BlockSystem& system) {
  return system.share() != nullptr && !system.share()->ranks().alone();
}

bool owns_any(const BlockShare& share, const std::vector<int>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [&](int block) { return share.owns(block); });
}

std::vector<ToldBolt> own_bolts(const BlockSystem& system, const RunState& state) {
  std::vector<ToldBolt> own;
  for (std::size_t k = 0; k < state.bolts.size(); ++k)
    if (owns_bolt(system, k)) own.push_back({static_cast<int>(k), state.bolts[k]});
  return own;
}

void take_told(std::vector<ToldBolt> told, RunState& state) {
  for (ToldBolt& one : told) state.bolts.at(at(one.bolt)) = std::move(one.state);
}

}  // namespace

bool knows_bolt(const BlockSystem& system, std::size_t bolt) {
  if (!is_shared(system)) return true;
  const std::vector<int> blocks = present_blocks(system.bolts()[bolt].chain);
  return owns_bolt(system, bolt) || std::any_of(blocks.begin(), blocks.end(), [&](int block) {
           return system.owns(block) && !system.blocks()[at(block)].fixed();
         });
}

bool owns_bolt(const BlockSystem& system, std::size_t bolt) {
  if (!is_shared(system)) return true;
  const BlockShare& share = *system.share();
  const std::vector<int> blocks = present_blocks(system.bolts()[bolt].chain);
  if (blocks.empty()) return share.ranks().own() == 0;
  // A rank without any of them does not know which are fixed.
  if (!owns_any(share, blocks)) return false;
  const auto lowest = std::find_if(blocks.begin(), blocks.end(),
                                   [&](int block) { return !system.blocks()[at(block)].fixed(); });
  return share.owns(lowest == blocks.end() ? blocks.front() : *lowest);
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

std::vector<int> with_bolted(const BlockSystem& system, std::vector<int> ghosts) {
  if (system.bolts().empty()) return ghosts;
  for (const Bolt& bolt : system.bolts()) {
    const std::vector<int> blocks = present_blocks(bolt.chain);
    if (!owns_any(*system.share(), blocks)) continue;
    std::copy_if(blocks.begin(), blocks.end(), std::back_inserter(ghosts),
                 [&](int block) { return !system.owns(block); });
  }
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  return ghosts;
}

void tell_bolts(const BlockSystem& system, RunState& state) {
  if (!is_shared(system) || system.bolts().empty()) return;
  for (std::vector<ToldBolt>& told : values_of_ranks(system.share()->ranks(), own_bolts(system, state)))
    take_told(std::move(told), state);
}

void send_bolts_to_first(const BlockSystem& system, RunState& state) {
  if (!is_shared(system) || system.bolts().empty()) return;
  send_to_first(
      system.share()->ranks(),
      [&](ByteWriter& writer) {
        if (const std::vector<ToldBolt> own = own_bolts(system, state); !own.empty()) writer(own);
      },
      [&](ByteReader& reader, int) {
        std::vector<ToldBolt> told;
        reader(told);
        take_told(std::move(told), state);
      });
}

}  // namespace ashlar

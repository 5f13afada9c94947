#include "solver/statics/loose_blocks.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/index.hpp"
#include "solver/archived_geometry.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/island/bolts_of_run.hpp"
#include "solver/step/island/island.hpp"

namespace ashlar {
namespace {

/// Blocks in contact with each other.
struct TouchingBlocks {
  std::vector<int> blocks;  ///< of one process, or of all
  bool held = false;        ///< by a support, or a contact with a supported block
};

bool is_support(const BlockModel& block) {
  return block.fixed() || block.supported();
}

/// Of blocks of this process, by the lowest of them on all processes. With other processes collective.
std::map<int, TouchingBlocks> touching_blocks(const BlockSystem& system, const RunState& state,
                                              const std::vector<ContactPair>& pairs) {
  const std::vector<StepBolt> bolts = bolts_of_step(system, state);
  std::vector<Island> islands = find_islands(system.moving(), pairs, bolts);
  const int shared = system.exchange().join_islands(system, islands);
  std::map<int, int> first;
  if (shared >= 0) first = system.exchange().first_blocks(system, islands[at(shared)], pairs);
  std::map<int, TouchingBlocks> touching;
  for (std::size_t n = 0; n < islands.size(); ++n) {
    const Island& island = islands[n];
    const auto set_of = [&](int block) -> TouchingBlocks& {
      return touching[static_cast<int>(n) == shared ? first.at(block) : island.bodies.front()];
    };
    for (const int block : island.bodies)
      if (system.owns(block)) set_of(block).blocks.push_back(block);
    if (island.pairs.empty() && island.bodies.size() == 1)
      set_of(island.bodies.front()).held = system.blocks()[at(island.bodies.front())].space().held();
    for (const int index : island.pairs) {
      const ContactPair& pair = pairs[at(index)];
      const bool held =
          is_support(system.blocks()[at(pair.a())]) || is_support(system.blocks()[at(pair.b())]);
      if (held) set_of(system.moving()[at(pair.a())] ? pair.a() : pair.b()).held = true;
    }
    for (const StepBolt* bolt : island.bolts)
      for (const int block : bolt->blocks())
        if (is_support(system.blocks()[at(block)])) set_of(moving_block(system, *bolt)).held = true;
  }
  return touching;
}

}  // namespace

std::vector<std::vector<int>> loose_blocks(const BlockSystem& system, RunState& state,
                                           StepContacts& contacts) {
  const std::vector<ContactPair> pairs =
      contacts.pairs(system, state, contacts.detect(system, state, 0.0), PairUse::statics);
  std::map<int, TouchingBlocks> touching = touching_blocks(system, state, pairs);
  if (!system.exchange().alone()) {
    const auto of_processes = values_of_run(system, touching);
    touching.clear();
    for (const std::map<int, TouchingBlocks>& of_process : of_processes) {
      for (const auto& [first, part] : of_process) {
        TouchingBlocks& all = touching[first];
        all.blocks.insert(all.blocks.end(), part.blocks.begin(), part.blocks.end());
        all.held = all.held || part.held;
      }
    }
  }
  std::vector<std::vector<int>> loose;
  for (auto& [first, part] : touching) {
    if (part.held) continue;
    std::sort(part.blocks.begin(), part.blocks.end());
    loose.push_back(std::move(part.blocks));
  }
  return loose;
}

}  // namespace ashlar

#include "apps/results/folder/contact_changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "apps/results/folder/run_status.hpp"
#include "solver/state/static_state.hpp"

namespace ashlar {

void ContactChanges::note(const Simulation& simulation) {
  ++iteration_;
  for (auto& [blocks, pair] : pairs_)
    std::erase_if(pair.changes, [this](int change) { return change <= iteration_ - window; });
  std::map<PairKey, std::array<int, 3>> now;
  for (const PairRecord& record : simulation.contacts()) {
    std::array<int, 3>& states = now[{record.a, record.b}];
    for (const PointResponse& point : record.responses) ++states[static_cast<std::size_t>(point.state)];
  }
  // A pair without contacts has separated.
  for (const auto& [blocks, pair] : pairs_) now.try_emplace(blocks);
  for (const auto& [blocks, states] : now) {
    const auto [found, is_new] = pairs_.try_emplace(blocks);
    Pair& pair = found->second;
    if (!is_new && pair.states != states) pair.changes.push_back(iteration_);
    pair.states = states;
  }
}

std::optional<ContactChanges::Alternating> ContactChanges::most() const {
  const auto found = std::max_element(pairs_.begin(), pairs_.end(), [](const auto& a, const auto& b) {
    return a.second.changes.size() < b.second.changes.size();
  });
  if (found == pairs_.end() || found->second.changes.empty()) return std::nullopt;
  return Alternating{found->first, static_cast<int>(found->second.changes.size()),
                     std::min(iteration_, window)};
}

static std::optional<DisplacedBlock> farthest_block(const Simulation& simulation) {
  std::optional<DisplacedBlock> farthest;
  for (std::size_t k = 0; k < simulation.blocks().size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (block.fixed()) continue;
    const double distance =
        mean_motion(block, simulation.states()[k].position - block.initial_state().position);
    if (!farthest || distance > farthest->distance) farthest = {static_cast<int>(k), distance};
  }
  return farthest;
}

std::string describe_unconverged(const Simulation& simulation, const ContactChanges& changes) {
  const auto name = [&](int block) { return simulation.blocks()[static_cast<std::size_t>(block)].name(); };
  std::string text = fmt::format("no equilibrium was found in {} iterations under the loads at t = {} s",
                                 simulation.steps(), simulation.time());
  if (simulation.steps() == 0 && !simulation.rejections().empty()) {
    text += fmt::format(": the first iteration was tried {} times; {}", simulation.rejections().size(),
                        reason_of(simulation.rejections().back(), simulation));
  } else if (const auto pair = changes.most()) {
    text += fmt::format(": contacts of blocks {} and {} changed in {} of the last {}", name(pair->blocks[0]),
                        name(pair->blocks[1]), pair->changes, pair->iterations);
  } else if (const auto farthest = farthest_block(simulation)) {
    text +=
        fmt::format(": contacts no longer changed, and blocks went on moving, block {} by {:.3g} m in all",
                    name(farthest->block), farthest->distance);
  }
  std::vector<const char*> remedies;
  const auto& blocks = simulation.blocks();
  if (std::any_of(blocks.begin(), blocks.end(),
                  [](const BlockModel& block) { return block.rigid() && !block.fixed(); }))
    remedies.push_back("order = 1 in place of 0");
  if (simulation.system().settings().augmented) remedies.push_back("springs (contact.augmented = false)");
  if (remedies.empty()) remedies.push_back("another normal_stiffness");
  return text + fmt::format("; {} may converge", fmt::join(remedies, ", or "));
}

}  // namespace ashlar

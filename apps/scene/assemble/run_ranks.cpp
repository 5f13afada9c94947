#include "apps/scene/assemble/run_ranks.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"

namespace ashlar {
namespace {

/// Adds the pairs of blocks along bolts that are not in a list yet. @param near the lower block first
void add_bolted(const std::vector<std::vector<int>>& bolted, std::vector<std::array<int, 2>>& near) {
  if (bolted.empty()) return;
  std::set<std::array<int, 2>> known(near.begin(), near.end());
  for (const std::vector<int>& blocks : bolted)
    for (std::size_t i = 0; i < blocks.size(); ++i)
      for (std::size_t j = i + 1; j < blocks.size(); ++j)
        if (known.insert({blocks[i], blocks[j]}).second) near.push_back({blocks[i], blocks[j]});
}

/// The blocks that a rank tells a partition of: every count-th. Blocks whose boxes are within a distance count as
/// neighbours with a point at each corner of a common rectangle, as blocks along a bolt do; contacts are not known before
/// the first step. Absent blocks have no neighbours.
std::vector<PartitionBlock> blocks_to_share(const SimulationParts& parts, const Ranks& ranks) {
  constexpr int points = 4;
  const std::vector<BlockSummary>& blocks = parts.blocks;
  const double distance = parts.settings.contact_distance;
  std::vector<Box> boxes;
  boxes.reserve(blocks.size());
  for (const BlockSummary& block : blocks) boxes.push_back(block.box.grown(0.5 * distance));
  std::vector<std::vector<int>> neighbours(blocks.size());
  const auto is_absent = [&parts](int block) { return !parts.absent.empty() && parts.absent[at(block)]; };
  std::vector<std::array<int, 2>> near = meeting_boxes(boxes);
  add_bolted(parts.bolted, near);
  for (const auto& [a, b] : near) {
    if (is_absent(a) || is_absent(b)) continue;
    if (blocks[at(a)].fixed() || blocks[at(b)].fixed()) continue;
    neighbours[at(a)].push_back(b);
    neighbours[at(b)].push_back(a);
  }
  std::vector<PartitionBlock> own;
  for (int k = ranks.own(); k < static_cast<int>(blocks.size()); k += ranks.count()) {
    PartitionBlock& block = own.emplace_back();
    block.block = k;
    block.neighbours = std::move(neighbours[at(k)]);
    block.points.assign(block.neighbours.size(), points);
    if (!is_absent(k))
      block.weight = std::max(
          1.0, weight_of_block(blocks[at(k)].freedom, points * static_cast<int>(block.points.size())));
    block.centroid = blocks[at(k)].centroid;
  }
  return own;
}

}  // namespace

Simulation simulation_of(const RunRanks* shared, SimulationParts parts, const BlockLoader& load) {
  if (shared == nullptr || !shared->several())
    return {std::move(parts.models), parts.motions, std::move(parts.law),
            parts.settings,          parts.ties,    std::move(parts.absent)};
  const RunRanks& ranks = *shared;
  const auto count = static_cast<int>(parts.blocks.size());
  std::vector<int> owners = ranks.partition(ranks.ranks, blocks_to_share(parts, ranks.ranks), count);
  BlocksOfRank blocks = share_blocks(ranks.ranks, std::move(owners), load, parts.settings,
                                     std::move(parts.absent), ranks.solver, ranks.first(), parts.ties);
  blocks.shared->balance.partition = ranks.partition;
  return {std::move(blocks), parts.motions, std::move(parts.law), parts.settings, parts.ties};
}

}  // namespace ashlar

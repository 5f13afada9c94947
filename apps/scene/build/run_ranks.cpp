#include "apps/scene/build/run_ranks.hpp"

#include <algorithm>
#include <utility>

#include "geometry/index.hpp"

namespace ashlar {

Simulation simulation_of(const RunRanks* shared, SimulationParts parts, const BlockLoader& load) {
  if (shared == nullptr || !shared->several())
    return {std::move(parts.blocks), parts.motions, std::move(parts.law),
            parts.settings,          parts.ties,    std::move(parts.absent)};
  const RunRanks& ranks = *shared;
  std::vector<PlacedVolume> places;
  std::vector<double> work;
  for (const BlockModel& block : parts.blocks) {
    places.push_back({block.basis().centroid(), block.basis().volume()});
    work.push_back(std::max(1.0, static_cast<double>(block.freedom())));
  }
  std::vector<int> owners = ranks.owners(ranks.ranks, places, work);
  // Blocks near at the start have been made; later ones are made again.
  const auto made = std::make_shared<std::vector<BlockModel>>(std::move(parts.blocks));
  const BlockLoader made_or_loaded = [made, load](int block) {
    return made->empty() ? load(block) : (*made)[at(block)];
  };
  BlocksOfRank blocks =
      share_blocks(ranks.ranks, std::move(owners), made_or_loaded, parts.settings, std::move(parts.absent),
                   ranks.solver ? ranks.solver(ranks.ranks) : nullptr, ranks.first());
  *made = {};
  return {std::move(blocks), parts.motions, std::move(parts.law), parts.settings, parts.ties};
}

}  // namespace ashlar

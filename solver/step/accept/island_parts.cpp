#include "solver/step/accept/island_parts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/index.hpp"
#include "solver/state/agreement.hpp"
#include "solver/step/island/bolts_of_run.hpp"

namespace ashlar {
namespace {

std::vector<bool> blocks_of_free_bodies(const BlockSystem& system) {
  std::vector<bool> free(at(system.count()), false);
  for (const std::vector<int>& body : system.free_bodies())
    for (const int block : body) free[at(block)] = true;
  return free;
}

/// Adds an island, or the parts of the joined one, by first block.
void add_parts(const BlockSystem& system, const Island& island, const std::map<int, int>& first_of_joined,
               const std::vector<ContactPair>& pairs, const std::vector<bool>& in_free_body,
               std::map<int, IslandPart>& parts) {
  const auto part_of = [&](int block) -> IslandPart& {
    const int first = first_of_joined.empty() ? island.bodies.front() : first_of_joined.at(block);
    IslandPart& part = parts[first];
    part.first = first;
    part.joined = !first_of_joined.empty();
    return part;
  };
  for (const int block : island.bodies) {
    if (!system.owns(block)) continue;
    IslandPart& part = part_of(block);
    part.bodies.push_back(block);
    part.free = part.free && in_free_body[at(block)];
  }
  for (const int n : island.pairs) {
    const ContactPair& pair = pairs[at(n)];
    const bool a_moves = system.moving()[at(pair.a())];
    IslandPart& part = part_of(a_moves ? pair.a() : pair.b());
    part.free = part.free && a_moves && system.moving()[at(pair.b())];
    part.depth = std::max(part.depth, pair.depth_of_multipliers());
    if (!pair.tied() && system.owns_pair(pair.a(), pair.b())) part.contacts.push_back({pair.a(), pair.b()});
  }
  for (const StepBolt* bolt : island.bolts)
    for (const int block : bolt->blocks())
      if (!system.moving()[at(block)]) part_of(moving_block(system, *bolt)).free = false;
}

}  // namespace

PartsOfRun::PartsOfRun(const BlockSystem& system, const std::vector<Island>& islands, int shared,
                       const std::vector<ContactPair>& pairs)
    : joined_(shared < 0 ? nullptr : &islands[at(shared)]), part_of_(at(system.count()), -1) {
  const std::vector<bool> in_free_body = blocks_of_free_bodies(system);
  std::map<int, IslandPart> by_first;
  for (const Island& island : islands) {
    std::map<int, int> first;
    if (&island == joined_) first = system.exchange().first_blocks(system, island, pairs);
    if (!island.bodies.empty()) add_parts(system, island, first, pairs, in_free_body, by_first);
  }
  std::vector<int> names;
  names.reserve(by_first.size());
  for (const auto& [first, part] : by_first) names.push_back(first);
  for (const int first : joined_of_run(system, names)) by_first[first].first = first;
  for (auto& [first, part] : by_first) {
    for (const int block : part.bodies) part_of_[at(block)] = static_cast<int>(parts.size());
    parts.push_back(std::move(part));
  }
}

std::vector<std::size_t> PartsOfRun::of_island(const Island& island) const {
  if (&island != joined_) return {part_of(island.bodies.front())};
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].joined) result.push_back(k);
  return result;
}

SumOverProcesses summed_over_processes(const BlockSystem& system) {
  return [&system](Eigen::MatrixXd& values) { sum_of_run(system, values); };
}

std::optional<SharedAccounts> shared_accounts(const BlockSystem& system) {
  if (system.exchange().alone()) return std::nullopt;
  return SharedAccounts{[&system](const PairKey& blocks) { return system.owns_pair(blocks[0], blocks[1]); },
                        [&system](const std::vector<double>& values) { return sum_of_run(system, values); }};
}

}  // namespace ashlar

#include "solver/step/island/island_links.hpp"

#include <set>

#include "geometry/index.hpp"

namespace ashlar {

std::vector<std::array<int, 2>> links_of(const Island& island, const std::vector<ContactPair>& pairs,
                                         const std::map<int, int>& place) {
  std::vector<std::array<int, 2>> links;
  for (const int index : island.pairs) {
    const auto a = place.find(pairs[at(index)].a());
    const auto b = place.find(pairs[at(index)].b());
    if (a != place.end() && b != place.end()) links.push_back({a->second, b->second});
  }
  if (island.bolts.empty()) return links;
  std::set<std::array<int, 2>> known(links.begin(), links.end());
  for (const StepBolt* bolt : island.bolts) {
    std::vector<int> ends;  // increasing, as the blocks are
    for (const int block : bolt->blocks())
      if (const auto end = place.find(block); end != place.end()) ends.push_back(end->second);
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = i + 1; j < ends.size(); ++j)
        if (known.insert({ends[i], ends[j]}).second) links.push_back({ends[i], ends[j]});
  }
  return links;
}

}  // namespace ashlar

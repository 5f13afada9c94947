#include "apps/scene/model/cut_rock.hpp"

#include <algorithm>
#include <set>

namespace ashlar {

std::vector<std::size_t> CutRock::cuts_between(std::size_t a, std::size_t b) const {
  const auto found = common.find(std::minmax(a, b));
  if (found != common.end()) return found->second;
  std::set<std::size_t> cuts;
  for (Side side : sides[a]) {
    side.below = !side.below;
    if (std::binary_search(sides[b].begin(), sides[b].end(), side)) cuts.insert(side.cut);
  }
  return {cuts.begin(), cuts.end()};
}

void CutRock::find_borders() {
  std::map<std::pair<std::size_t, int>, std::size_t> block_of;
  for (std::size_t k = 0; k < origin.size(); ++k) block_of[{origin[k].uncut, origin[k].piece}] = k;
  sides.assign(origin.size(), {});
  std::map<std::pair<std::size_t, std::size_t>, std::set<std::size_t>> pairs;
  for (std::size_t k = 0; k < origin.size(); ++k) {
    const auto& [uncut, piece] = origin[k];
    if (piece < 0) continue;
    for (const PieceFace& face : solids[uncut]->faces(piece)) {
      if (face.mark < 0) continue;
      const std::size_t cut = marks[static_cast<std::size_t>(face.mark)].cut;
      sides[k].push_back({uncut, face.plane, face.below, cut});
      if (face.neighbour >= 0) pairs[std::minmax(k, block_of.at({uncut, face.neighbour}))].insert(cut);
    }
    std::sort(sides[k].begin(), sides[k].end());
    sides[k].erase(std::unique(sides[k].begin(), sides[k].end()), sides[k].end());
  }
  for (const auto& [pair, cuts] : pairs) common[pair] = {cuts.begin(), cuts.end()};
}

}  // namespace ashlar

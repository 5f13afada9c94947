#include "solver/contact/pair_history.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace ashlar {

const PairHistory& history_of(const PairHistories& histories, const PairKey& pair) {
  static const PairHistory nothing;
  const auto known = histories.find(pair);
  return known == histories.end() ? nothing : known->second;
}

void drop_empty(PairHistories& histories) {
  std::erase_if(histories, [](const auto& entry) {
    const PairHistory& pair = entry.second;
    return pair.memory.empty() && !pair.cache && !pair.clearance && !pair.entrance && pair.work == 0.0 &&
           pair.spent == 0.0 && pair.depth == 0.0 && pair.bonded == 0.0 && pair.overlap == 0.0;
  });
}

void validate(const PairHistories& histories, int blocks) {
  for (const auto& [key, pair] : histories) {
    const auto demand = [&key = key](bool holds, const char* what) {
      if (holds) return;
      throw std::logic_error("history of blocks " + std::to_string(key[0]) + " and " +
                             std::to_string(key[1]) + ": " + what);
    };
    const auto is_size = [](double value) { return std::isfinite(value) && value >= 0.0; };
    demand(0 <= key[0] && key[0] < key[1] && key[1] < blocks, "blocks are not in order");
    demand(std::isfinite(pair.work), "work is not finite");
    demand(is_size(pair.spent), "work of multipliers is negative or not finite");
    demand(is_size(pair.bonded) && is_size(pair.broken), "an area of bonds is negative or not finite");
    demand(is_size(pair.depth) && is_size(pair.overlap), "depth is negative or not finite");
    demand(is_size(pair.memory.deepest()) && is_size(pair.memory.bulge()),
           "depth of contacts is negative or not finite");
    demand(!pair.cache || pair.cache->found.points.empty() ||
               pair.cache->found.points.size() == pair.memory.entries().size(),
           "cached points are not those of the memory");
    demand(!pair.clearance || !std::isnan(pair.clearance->distance + pair.clearance->path),
           "clearance is not a number");
    for (const ContactMemory::Entry& entry : pair.memory.entries()) {
      demand(entry.face_a >= 0 && entry.face_b >= 0, "a point without faces");
      demand(is_size(entry.area), "an area is negative or not finite");
      demand(entry.memory.damage >= 0.0 && entry.memory.damage <= 1.0,
             "damage of a bond is not within 0 and 1");
    }
  }
}

}  // namespace ashlar

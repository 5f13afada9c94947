// Continuous collision check: the part of ContactFinder that follows the motion of blocks.
#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"
#include "solver/contact/contact_finder.hpp"
#include "solver/contact/covered_faces.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {

std::vector<PairKey> ContactFinder::pairs_that_may_pass(const std::vector<BlockState>& before,
                                                        const std::vector<BlockState>& after,
                                                        double tolerance, const PairHistories& histories,
                                                        std::vector<std::vector<Vector3>>& ends) {
  double most = 0.0;  // of any block
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    tracks_[k].checked_motion =
        moving_[k] ? surfaces_[k].quick_motion_bound(after[k].position - before[k].position) : 0.0;
    most = std::max(most, tracks_[k].checked_motion);
  }
  if (2.0 * most <= tolerance) return {};
  std::vector<Box> swept;
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    swept.push_back(absent_[k] ? Box{} : loose_box(static_cast<int>(k)).grown(tracks_[k].checked_motion));
  }
  const auto both = [&](const PairKey& pair) {
    return tracks_[at(pair[0])].checked_motion + tracks_[at(pair[1])].checked_motion;
  };
  std::vector<PairKey> pairs = meeting_boxes(swept);
  std::erase_if(pairs, [&](const PairKey& pair) {
    return leaves_out(pair[0], pair[1]) || both(pair) <= tolerance ||
           known_apart(pair, both(pair), histories);
  });
  // The remaining pairs are checked with the true surfaces and their true motion.
  ends.resize(surfaces_.size());
  for (const PairKey& pair : pairs) {
    for (const int block : pair) {
      if (!ends[at(block)].empty()) continue;
      if (!placed_[at(block)]) {
        look_at(block, before[at(block)]);
        placed_[at(block)] = surfaces_[at(block)].placed();
      }
      if (!moving_[at(block)]) continue;
      tracks_[at(block)].checked_motion =
          surfaces_[at(block)].motion_bound(before[at(block)], after[at(block)]);
      ends[at(block)] = surfaces_[at(block)].points(after[at(block)]);
    }
  }
  std::erase_if(pairs, [&](const PairKey& pair) {
    const Box of_a = tracks_[at(pair[0])].box.grown(tracks_[at(pair[0])].checked_motion);
    const Box of_b = tracks_[at(pair[1])].box.grown(tracks_[at(pair[1])].checked_motion);
    return both(pair) <= tolerance || known_apart(pair, both(pair), histories) || !of_a.meets(of_b);
  });
  return pairs;
}

std::optional<PlacedSurface> ContactFinder::end_of(int block,
                                                   const std::vector<std::vector<Vector3>>& ends) const {
  if (!moving_[at(block)]) return std::nullopt;
  return PlacedSurface(surfaces_[at(block)].surface(), ends[at(block)]);
}

std::vector<PassingBlocks> ContactFinder::check_motion(const std::vector<BlockState>& before,
                                                       const std::vector<BlockState>& after,
                                                       const std::vector<FoundContacts>& found,
                                                       const PairHistories& histories) {
  const double tolerance = settings_.search.passing_share * settings_.contact_distance;
  std::vector<std::vector<Vector3>> ends;
  const std::vector<PairKey> pairs = pairs_that_may_pass(before, after, tolerance, histories, ends);
  counts_.motions_checked += pairs.size();
  if (pairs.empty()) return {};
  place_near(before);
  if (!sides_.noted()) {
    std::vector<PairOfContacts> all;
    all.reserve(found.size());
    for (const FoundContacts& pair : found) all.emplace_back(pair.blocks, &pair.contacts);
    sides_.note(all, surfaces_);
  }
  std::vector<std::vector<Touch>> touches(pairs.size());
  parallel_for(settings_.threads, pairs.size(), [&](std::size_t k) {
    const auto& [a, b] = pairs[k];
    const std::optional<PlacedSurface> placed_a = end_of(a, ends), placed_b = end_of(b, ends);
    const PlacedSurface& end_a = placed_a ? *placed_a : placed(a);
    const PlacedSurface& end_b = placed_b ? *placed_b : placed(b);
    const auto known = std::lower_bound(
        found.begin(), found.end(), pairs[k],
        [](const FoundContacts& contacts, const PairKey& pair) { return contacts.blocks < pair; });
    const bool in_contact = known != found.end() && known->blocks == pairs[k];
    const MotionLimits limits{tolerance, settings_.contact_distance + tracks_[at(a)].checked_motion +
                                             tracks_[at(b)].checked_motion};
    touches[k] = find_touches({&placed(a), &end_a}, {&placed(b), &end_b},
                              in_contact ? known->contacts : PairContacts{}, limits);
    if (sides_.hidden().empty()) return;
    const OccludedPlaces hidden = sides_.hidden().of_pair(pairs[k]);
    turn_to_open_faces({&placed(a), &end_a}, {&placed(b), &end_b}, hidden, touches[k]);
  });
  std::vector<PassingBlocks> passing;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (const Touch& touch : touches[k]) passing.push_back({pairs[k], touch});
  }
  std::stable_sort(passing.begin(), passing.end(), [](const PassingBlocks& x, const PassingBlocks& y) {
    return x.touch.share < y.touch.share;
  });
  return passing;
}

}  // namespace ashlar

#include "solver/contact/contact_finder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/boxes/box_pairs.hpp"
#include "geometry/index.hpp"
#include "geometry/solid/face_axes.hpp"
#include "geometry/solid/rounded_convexity.hpp"
#include "geometry/subfaces/surface_distance.hpp"
#include "mechanics/contact/overlap_outline.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

/// Axes of the boxes: along the largest face of all blocks; the first of faces that are equal within rounding error.
Eigen::Matrix3d axes_of(const std::vector<BlockModel>& blocks) {
  constexpr double rounding = 1e-9;
  std::vector<const Polyhedron*> solids;
  solids.reserve(blocks.size());
  for (const BlockModel& block : blocks) solids.push_back(&block.solid());
  return axes_along_largest_face(solids, rounding);
}

/// Removes overlaps so thin that they have no contact points. For adjacent coplanar faces the existence of such an
/// overlap is a matter of rounding and must not indicate contact.
void leave_out_slivers(const PlacedSurface& a, const PlacedSurface& b, PairContacts& contacts) {
  const double tolerance = outline_tolerance(a, b);
  std::erase_if(contacts.overlaps, [tolerance](const CellOverlap& overlap) {
    return outline_of(places_of(overlap), tolerance).empty();
  });
}

/// By block: true for present blocks that never move. @param absent by block, or empty
std::vector<bool> fixed_and_present(const std::vector<BlockModel>& blocks, const std::vector<bool>& absent) {
  std::vector<bool> fixed;
  fixed.reserve(blocks.size());
  for (const BlockModel& block : blocks)
    fixed.push_back(block.fixed() && (absent.empty() || !absent[fixed.size()]));
  return fixed;
}

}  // namespace

ContactFinder::ContactFinder(const std::vector<BlockModel>& blocks, const SimulationSettings& settings,
                             std::set<PairKey> left_out, std::vector<bool> absent, ContactObserver observer,
                             const std::optional<Eigen::Matrix3d>& axes)
    : settings_(settings),
      contact_angle_(settings.search.contact_angle),
      observer_(std::move(observer)),
      axes_(axes ? *axes : axes_of(blocks)),
      absent_(std::move(absent)),
      left_out_(std::move(left_out)),
      placed_(blocks.size()),
      tracks_(blocks.size()),
      sides_(fixed_and_present(blocks, absent_), settings) {
  surfaces_.reserve(blocks.size());
  absent_.resize(blocks.size(), false);
  std::map<const BlockParts*, std::size_t> first;  // of equal blocks
  for (const BlockModel& block : blocks) {
    const auto [twin, is_first] = first.emplace(block.parts().get(), surfaces_.size());
    surfaces_.emplace_back(block, settings.search.subdivisions, axes_,
                           is_first ? nullptr : &surfaces_[twin->second]);
    moving_.push_back(!block.fixed() && !absent_[moving_.size()]);
    thickness_.push_back(block.basis().volume() / surface_area(block.solid().mesh()));
    convex_.push_back(!surfaces_.back().surface().divided && is_convex_but_for_rounding(block.solid()));
  }
}

ExpectedMotion ContactFinder::expected_motion(const std::vector<BlockState>& states, double step) const {
  const double fall = 0.5 * step * step * settings_.largest_gravity();
  ExpectedMotion motion;
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    const double speed = moving_[k] ? surfaces_[k].quick_motion_bound(states[k].velocity) : 0.0;
    motion.loose.push_back(moving_[k] ? step * speed + fall : 0.0);
  }
  motion.fall = fall;
  motion.closer = [this, &states, step, fall](int block) {
    return moving_[at(block)] ? step * surfaces_[at(block)].largest_speed(states[at(block)]) + fall : 0.0;
  };
  return motion;
}

Box ContactFinder::loose_box(int block) const {
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  const Box& box = tracks_[at(block)].box;
  if (box.low.x() > box.high.x()) return {Vector3::Constant(-everywhere), Vector3::Constant(everywhere)};
  return box.grown(tracks_[at(block)].path - tracks_[at(block)].box_path);
}

void ContactFinder::look_at(int block, const BlockState& state) {
  surfaces_[at(block)].move(state);
  tracks_[at(block)].box = surfaces_[at(block)].box();
  tracks_[at(block)].box_path = tracks_[at(block)].path;
}

std::vector<Box> ContactFinder::near_boxes(const std::vector<BlockState>& states,
                                           const ExpectedMotion& motion, double reach) {
  std::vector<Box> loose;
  for (std::size_t k = 0; k < surfaces_.size(); ++k)
    loose.push_back(absent_[k] ? Box{} : loose_box(static_cast<int>(k)).grown(motion.loose[k] + reach));
  std::vector<bool> near(surfaces_.size(), false);
  for (const PairKey& pair : meeting_boxes(loose)) {
    if (can_meet(pair)) near[at(pair[0])] = near[at(pair[1])] = true;
  }
  std::vector<Box> boxes(surfaces_.size());
  // Positions need not be known more accurately than this.
  const double enough = settings_.cached_motion();
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    BlockTrack& track = tracks_[k];
    track.motion = 0.0;
    if (!near[k]) continue;
    const bool unseen = track.box.low.x() > track.box.high.x();
    if (unseen || surfaces_[k].curves() || !(track.path - track.box_path <= enough))
      look_at(static_cast<int>(k), states[k]);
    track.motion =
        motion.loose[k] - motion.fall <= enough ? motion.loose[k] : motion.closer(static_cast<int>(k));
    boxes[k] = loose_box(static_cast<int>(k)).grown(track.motion + reach);
  }
  return boxes;
}

void ContactFinder::divide_curved(const std::vector<PairKey>& candidates, const std::vector<Box>& boxes) {
  std::vector<std::vector<Box>> neighbours(surfaces_.size());
  for (const PairKey& pair : candidates) {
    if (surfaces_[at(pair[0])].curves()) neighbours[at(pair[0])].push_back(boxes[at(pair[1])]);
    if (surfaces_[at(pair[1])].curves()) neighbours[at(pair[1])].push_back(boxes[at(pair[0])]);
  }
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    const bool looked_at = boxes[k].low.x() <= boxes[k].high.x();
    if (!looked_at || !surfaces_[k].curves()) continue;
    if (surfaces_[k].divide({settings_.search.chord_tolerance, neighbours[k]})) ++counts_.divisions;
    const std::size_t cells = surfaces_[k].surface().cells.size();
    if (cells >= static_cast<std::size_t>(AdaptiveSurface::max_cells)) ++counts_.divisions_at_limit;
  }
}

const std::vector<NearPair>& ContactFinder::near_pairs(const std::vector<BlockState>& states,
                                                       const ExpectedMotion& motion,
                                                       const PairHistories& histories) {
  // Blocks separated by dilation touch across that gap.
  const auto distance = [&](const PairHistory& pair) {
    return settings_.contact_distance + pair.memory.most_dilation();
  };
  double farthest = settings_.contact_distance;
  for (const auto& [blocks, pair] : histories) farthest = std::max(farthest, distance(pair));
  const std::vector<Box> boxes = near_boxes(states, motion, farthest);
  std::vector<PairKey> candidates = meeting_boxes(boxes);
  std::erase_if(candidates, [this](const PairKey& pair) { return !can_meet(pair); });
  divide_curved(candidates, boxes);
  for (std::size_t k = 0; k < placed_.size(); ++k)
    if (moving_[k] || surfaces_[k].curves()) placed_[k].reset();
  near_.clear();
  for (const PairKey& pair : candidates) {
    const double reach =
        distance(history_of(histories, pair)) + tracks_[at(pair[0])].motion + tracks_[at(pair[1])].motion;
    if (known_apart(pair, reach, histories)) {
      ++counts_.block_pairs_far;
      continue;
    }
    near_.push_back({pair, reach});
  }
  counts_.block_pairs_skipped += surfaces_.size() * (surfaces_.size() - 1) / 2 - candidates.size();
  return near_;
}

void ContactFinder::forget_neighbours(KnownContacts& known) const {
  std::vector<std::vector<std::pair<int, std::size_t>>> neighbours(surfaces_.size());  // with the pair
  for (std::size_t n = 0; n < near_.size(); ++n) {
    const auto [a, b] = near_[n].blocks;
    neighbours[at(a)].emplace_back(b, n);
    neighbours[at(b)].emplace_back(a, n);
  }
  if (std::all_of(known.begin(), known.end(), [](const PairContacts* one) { return one == nullptr; })) return;
  std::vector<std::size_t> forgotten;
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (known[n] != nullptr) continue;
    const auto* few = &neighbours[at(near_[n].blocks[0])];
    const auto* many = &neighbours[at(near_[n].blocks[1])];
    if (few->size() > many->size()) std::swap(few, many);
    for (const auto& [block, pair] : *few) {
      // Lists are sorted by block, as pairs are.
      const auto common = std::lower_bound(many->begin(), many->end(), std::pair(block, std::size_t{0}));
      if (common == many->end() || common->first != block) continue;
      forgotten.insert(forgotten.end(), {pair, common->second});
    }
  }
  for (const std::size_t n : forgotten) known[n] = nullptr;
}

void ContactFinder::place_near(const std::vector<BlockState>& states) {
  for (const NearPair& pair : near_) {
    for (const int block : pair.blocks) {
      if (placed_[at(block)]) continue;
      // Curved blocks have been evaluated: cells are as of their last division.
      if (!surfaces_[at(block)].curves()) look_at(block, states[at(block)]);
      placed_[at(block)] = surfaces_[at(block)].placed();
    }
  }
}

bool ContactFinder::known_apart(const PairKey& pair, double reach, const PairHistories& histories) const {
  const std::optional<Clearance>& known = history_of(histories, pair).clearance;
  if (!known) return false;
  const double gone = tracks_[at(pair[0])].path + tracks_[at(pair[1])].path - known->path;
  return known->distance - gone > reach;
}

Clearance ContactFinder::clearance_of(const PairKey& pair) const {
  const double bound = least_distance(placed(pair[0]), placed(pair[1]));
  // Rounding of sums of paths is far below a part in a million of the distance.
  return {bound * (1.0 - 1e-6), tracks_[at(pair[0])].path + tracks_[at(pair[1])].path};
}

void ContactFinder::search_below_occluded(std::vector<FoundContacts>& searched, const KnownContacts& known,
                                          const std::vector<ContactLimits>& limits) {
  std::vector<PairOfContacts> all;
  all.reserve(searched.size());
  for (const auto& pair : searched) all.emplace_back(pair.blocks, &pair.contacts);
  for (std::size_t n = 0; n < near_.size(); ++n)
    if (known[n] != nullptr) all.emplace_back(near_[n].blocks, known[n]);
  sides_.note(all, surfaces_);
  if (sides_.hidden().empty()) return;
  std::vector<std::size_t> again;
  for (std::size_t k = 0; k < searched.size(); ++k) {
    const auto& blocks = searched[k].blocks;
    const auto& contacts = searched[k].contacts;
    const OccludedPlaces places = sides_.hidden().of_pair(blocks);
    const bool below =
        std::any_of(contacts.vertices.begin(), contacts.vertices.end(), [&](const auto& contact) {
          const PlacedSurface& with_cell = placed(blocks[contact.vertex_of_a ? 1 : 0]);
          const PlacedSurface& with_vertex = placed(blocks[contact.vertex_of_a ? 0 : 1]);
          const Vector3 foot =
              with_vertex.point(contact.point) - contact.gap * with_cell.normal(contact.cell);
          const auto& hides = contact.vertex_of_a ? places.of_b : places.of_a;
          return contact.gap < 0.0 && hides(with_cell.surface().cells[at(contact.cell)].face, foot);
        });
    if (below) again.push_back(k);
  }
  parallel_for(settings_.threads, again.size(), [&](std::size_t n) {
    const PairKey& blocks = searched[again[n]].blocks;
    PairContacts& contacts = searched[again[n]].contacts;
    const OccludedPlaces places = sides_.hidden().of_pair(blocks);
    const DecisionCounts counts = contacts.counts;
    contacts = find_contacts(placed(blocks[0]), placed(blocks[1]), limits[again[n]], &places);
    contacts.counts.filter += counts.filter;
    contacts.counts.exact += counts.exact;
    leave_out_slivers(placed(blocks[0]), placed(blocks[1]), contacts);
  });
  for (const std::size_t k : again) hidden_.insert(searched[k].blocks);
}

void ContactFinder::settle_convex_pairs(std::vector<FoundContacts>& searched, const KnownContacts& known,
                                        PairHistories& histories) {
  std::map<PairKey, EntranceName> entrances;
  std::vector<std::size_t> open;
  std::vector<std::optional<ConvexSurface>> hulls(surfaces_.size());
  for (std::size_t k = 0; k < searched.size(); ++k) {
    const PairKey& blocks = searched[k].blocks;
    PairContacts& contacts = searched[k].contacts;
    // Occluded faces of hulls are unknown there.
    if (!convex_[at(blocks[0])] || !convex_[at(blocks[1])] || hidden_.count(blocks) > 0) continue;
    if (!contacts.overlaps.empty()) {
      contacts.type = ContactType::face_face;
      entrances.emplace(blocks, entrance_of_faces(contacts.overlaps.front()));
      continue;
    }
    open.push_back(k);
    for (const int block : blocks)
      if (!hulls[at(block)]) hulls[at(block)].emplace(placed(block));
  }
  counts_.convex_pairs += open.size();
  std::vector<std::optional<EntranceName>> decided(open.size());
  parallel_for(settings_.threads, open.size(), [&](std::size_t k) {
    const PairKey& blocks = searched[open[k]].blocks;
    PairContacts& contacts = searched[open[k]].contacts;
    ContactHistory history;
    const PairHistory& before = history_of(histories, blocks);
    history.entrance = before.entrance;
    // A block that was less deep in the last step has not entered through that facet.
    history.depth =
        settings_.search.passing_share * settings_.contact_distance + 2.0 * before.depth_to_search();
    history.rounding = coordinate_rounding(placed(blocks[0]), placed(blocks[1]));
    decided[k] = settle_convex_contacts(*hulls[at(blocks[0])], *hulls[at(blocks[1])], history, contacts);
  });
  for (std::size_t k = 0; k < open.size(); ++k)
    if (decided[k]) entrances.emplace(searched[open[k]].blocks, *decided[k]);
  std::set<PairKey> kept;
  for (std::size_t n = 0; n < near_.size(); ++n)
    if (known[n] != nullptr) kept.insert(near_[n].blocks);
  for (auto& [blocks, pair] : histories)
    if ((moving_[at(blocks[0])] || moving_[at(blocks[1])]) && kept.count(blocks) == 0) pair.entrance.reset();
  for (const auto& [blocks, name] : entrances) histories[blocks].entrance = name;
}

ContactLimits ContactFinder::limits_of(const NearPair& pair, const PairHistories& histories) const {
  const auto& [a, b] = pair.blocks;
  return {pair.reach,
          std::min({settings_.contact_distance, thickness_[at(a)], thickness_[at(b)]}) +
              2.0 * history_of(histories, pair.blocks).depth_to_search(),
          contact_angle_, thickness_[at(a)] + thickness_[at(b)]};
}

std::vector<FoundContacts> ContactFinder::find(const std::vector<BlockState>& states,
                                               const ExpectedMotion& motion, PairHistories& histories) {
  KnownContacts known(near_pairs(states, motion, histories).size(), nullptr);
  return find(states, known, histories);
}

std::vector<FoundContacts> ContactFinder::find(const std::vector<BlockState>& states, KnownContacts& known,
                                               PairHistories& histories) {
  hidden_.clear();
  sides_.begin();
  const auto is_unknown = [](const PairContacts* contacts) { return contacts == nullptr; };
  if (std::none_of(known.begin(), known.end(), is_unknown)) {
    counts_.block_pairs_kept += known.size();
    return {};
  }
  forget_neighbours(known);
  place_near(states);
  std::vector<FoundContacts> searched;
  std::vector<ContactLimits> limits;
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (known[n] != nullptr) continue;
    searched.push_back({near_[n].blocks, {}, near_[n].reach});
    limits.push_back(limits_of(near_[n], histories));
  }
  counts_.block_pairs_kept += known.size() - searched.size();
  counts_.block_pairs_tested += searched.size();
  parallel_for(settings_.threads, searched.size(), [&](std::size_t k) {
    const auto& [a, b] = searched[k].blocks;
    searched[k].contacts = find_contacts(placed(a), placed(b), limits[k]);
  });
  observe(ContactStage::search, searched);
  parallel_for(settings_.threads, searched.size(), [&](std::size_t k) {
    const auto& [a, b] = searched[k].blocks;
    leave_out_slivers(placed(a), placed(b), searched[k].contacts);
  });
  observe(ContactStage::area, searched);
  search_below_occluded(searched, known, limits);
  observe(ContactStage::occluded_faces, searched);
  settle_convex_pairs(searched, known, histories);
  observe(ContactStage::entrance, searched);
  std::vector<FoundContacts> found;
  for (FoundContacts& pair : searched) {
    counts_.cells_near += static_cast<std::uint64_t>(pair.contacts.cells_near);
    counts_.predicates.filter += pair.contacts.counts.filter;
    counts_.predicates.exact += pair.contacts.counts.exact;
    std::optional<Clearance>& clearance = histories[pair.blocks].clearance;
    if (pair.contacts.empty()) {
      clearance = clearance_of(pair.blocks);
    } else {
      clearance.reset();
      found.push_back(std::move(pair));
    }
  }
  return found;
}

void ContactFinder::accept_motion() {
  for (BlockTrack& track : tracks_) track.path += track.checked_motion;
}

FinderState ContactFinder::state() const {
  FinderState state{tracks_, {}, counts_};
  for (const BlockSurface& surface : surfaces_) state.divisions.push_back(surface.division());
  return state;
}

void ContactFinder::restore(const FinderState& state) {
  tracks_ = state.tracks;
  for (std::size_t k = 0; k < surfaces_.size() && k < state.divisions.size(); ++k)
    surfaces_[k].restore(state.divisions[k]);
  counts_ = state.counts;
}

}  // namespace ashlar

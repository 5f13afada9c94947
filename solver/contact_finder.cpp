#include "solver/contact_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/box_pairs.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Width of the slab across a direction between two surfaces: no two points of them are nearer, however they
/// curve. Negative if the direction does not separate them.
double slab_between(const PlacedSurface& a, const PlacedSurface& b, const Vector3& direction) {
  const auto extreme = [&](const PlacedSurface& surface, double sign) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3& point : surface.points()) most = std::max(most, sign * direction.dot(point));
    return most;
  };
  const double size = std::max(a.box().high.cwiseAbs().maxCoeff(), b.box().high.cwiseAbs().maxCoeff()) +
                      std::max(a.box().low.cwiseAbs().maxCoeff(), b.box().low.cwiseAbs().maxCoeff());
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * size;
  return -extreme(b, -1.0) - extreme(a, 1.0) - a.largest_chord_bound() - b.largest_chord_bound() - rounding;
}

/// No two points of the true surfaces are nearer than this: the widest slab across an axis, the line between
/// the middles or a face.
double distance_bound(const PlacedSurface& a, const PlacedSurface& b) {
  const Vector3 between = 0.5 * (b.box().low + b.box().high - a.box().low - a.box().high);
  double bound = (a.box().low - b.box().high).cwiseMax(b.box().low - a.box().high).cwiseMax(0.0).norm();
  if (between.norm() > 0.0) bound = std::max(bound, slab_between(a, b, between.normalized()));
  for (int cell = 0; cell < static_cast<int>(a.surface().cells.size()); ++cell)
    bound = std::max(bound, slab_between(a, b, a.normal(cell)));
  for (int cell = 0; cell < static_cast<int>(b.surface().cells.size()); ++cell)
    bound = std::max(bound, slab_between(a, b, -b.normal(cell)));
  return bound;
}

}  // namespace

ContactFinder::ContactFinder(const std::vector<BlockModel>& blocks, const SimulationSettings& settings)
    : settings_(settings), paths_(blocks.size(), 0.0), checked_motion_(blocks.size(), 0.0) {
  surfaces_.reserve(blocks.size());
  for (const BlockModel& block : blocks) {
    surfaces_.emplace_back(block, settings.subdivisions);
    moving_.push_back(!block.fixed());
  }
}

double ContactFinder::expected_motion(int block, const BlockState& state, double step) const {
  if (!moving_[at(block)]) return 0.0;
  return step * surfaces_[at(block)].largest_speed(state) + 0.5 * step * step * settings_.gravity.norm();
}

void ContactFinder::place(const std::vector<BlockState>& states, const std::vector<double>& motion) {
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    surfaces_[k].move(states[k]);
    boxes.push_back(surfaces_[k].box().grown(motion[k] + settings_.contact_distance));
  }
  candidates_.clear();
  std::vector<std::vector<Box>> neighbours(surfaces_.size());
  for (const auto& [a, b] : meeting_boxes(boxes)) {
    if (!moving_[at(a)] && !moving_[at(b)]) continue;
    candidates_.push_back({a, b});
    neighbours[at(a)].push_back(boxes[at(b)]);
    neighbours[at(b)].push_back(boxes[at(a)]);
  }
  placed_.clear();
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    if (surfaces_[k].divide({settings_.chord_tolerance, neighbours[k]})) ++counts_.divisions;
    const std::size_t cells = surfaces_[k].surface().cells.size();
    if (cells >= static_cast<std::size_t>(AdaptiveSurface::max_cells)) ++counts_.divisions_at_limit;
  }
  for (const BlockSurface& surface : surfaces_) placed_.push_back(surface.placed());
}

bool ContactFinder::known_apart(const PairKey& pair, double reach) const {
  const auto known = clearances_.find(pair);
  if (known == clearances_.end()) return false;
  const double gone = paths_[at(pair[0])] + paths_[at(pair[1])] - known->second.path;
  return known->second.distance - gone > reach;
}

void ContactFinder::note_clearance(const PairKey& pair) {
  const double bound = distance_bound(placed_[at(pair[0])], placed_[at(pair[1])]);
  // Rounding of sums of paths is far below a part in a million of the distance.
  clearances_[pair] = {bound * (1.0 - 1e-6), paths_[at(pair[0])] + paths_[at(pair[1])]};
}

std::vector<FoundContacts> ContactFinder::find(const std::vector<BlockState>& states,
                                               const std::vector<double>& motion,
                                               const std::function<double(int, int)>& deepest) {
  place(states, motion);
  const std::size_t all = surfaces_.size() * (surfaces_.size() - 1) / 2;
  counts_.block_pairs_skipped += all - candidates_.size();
  std::vector<FoundContacts> searched;
  std::vector<ContactLimits> limits;
  for (const PairKey& pair : candidates_) {
    const double both = motion[at(pair[0])] + motion[at(pair[1])];
    if (known_apart(pair, settings_.contact_distance + both)) {
      ++counts_.block_pairs_far;
      continue;
    }
    searched.push_back({pair, {}});
    limits.push_back({settings_.contact_distance + both,
                      settings_.contact_distance + 2.0 * deepest(pair[0], pair[1]), settings_.contact_angle});
  }
  counts_.block_pairs_tested += searched.size();
  parallel_for(settings_.threads, searched.size(), [&](std::size_t k) {
    const auto& [a, b] = searched[k].blocks;
    searched[k].contacts = find_contacts(placed_[at(a)], placed_[at(b)], limits[k]);
  });
  std::vector<FoundContacts> found;
  for (FoundContacts& pair : searched) {
    counts_.predicates.filter += pair.contacts.counts.filter;
    counts_.predicates.exact += pair.contacts.counts.exact;
    if (pair.contacts.empty()) {
      note_clearance(pair.blocks);
    } else {
      clearances_.erase(pair.blocks);
      found.push_back(std::move(pair));
    }
  }
  return found;
}

std::vector<PassingBlocks> ContactFinder::check_motion(const std::vector<BlockState>& before,
                                                       const std::vector<BlockState>& after,
                                                       const std::vector<FoundContacts>& found) {
  const double tolerance = settings_.passing_share * settings_.contact_distance;
  std::vector<std::vector<Vector3>> ends(surfaces_.size());
  std::vector<Box> swept;
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    checked_motion_[k] = moving_[k] ? surfaces_[k].motion_bound(before[k], after[k]) : 0.0;
    swept.push_back(surfaces_[k].box().grown(checked_motion_[k]));
  }
  std::vector<PairKey> pairs;
  for (const PairKey& pair : meeting_boxes(swept)) {
    const double both = checked_motion_[at(pair[0])] + checked_motion_[at(pair[1])];
    if (both <= tolerance || known_apart(pair, both)) continue;
    pairs.push_back(pair);
    for (const int block : pair) {
      if (ends[at(block)].empty()) ends[at(block)] = surfaces_[at(block)].points(after[at(block)]);
    }
  }
  counts_.motions_checked += pairs.size();
  std::vector<std::vector<Touch>> touches(pairs.size());
  parallel_for(settings_.threads, pairs.size(), [&](std::size_t k) {
    const auto& [a, b] = pairs[k];
    const PlacedSurface end_a(surfaces_[at(a)].surface(), ends[at(a)]);
    const PlacedSurface end_b(surfaces_[at(b)].surface(), ends[at(b)]);
    const auto known = std::lower_bound(
        found.begin(), found.end(), pairs[k],
        [](const FoundContacts& contacts, const PairKey& pair) { return contacts.blocks < pair; });
    const bool in_contact = known != found.end() && known->blocks == pairs[k];
    const MotionLimits limits{tolerance,
                              settings_.contact_distance + checked_motion_[at(a)] + checked_motion_[at(b)]};
    touches[k] = find_touches({&placed_[at(a)], &end_a}, {&placed_[at(b)], &end_b},
                              in_contact ? known->contacts : PairContacts{}, limits);
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

void ContactFinder::accept_motion() {
  for (std::size_t k = 0; k < paths_.size(); ++k) paths_[k] += checked_motion_[k];
}

FinderState ContactFinder::state() const {
  FinderState state{paths_, clearances_, {}, counts_};
  for (const BlockSurface& surface : surfaces_) state.divisions.push_back(surface.wanted());
  return state;
}

void ContactFinder::restore(const FinderState& state) {
  paths_ = state.paths;
  clearances_ = state.clearances;
  for (std::size_t k = 0; k < surfaces_.size() && k < state.divisions.size(); ++k)
    surfaces_[k].set_wanted(state.divisions[k]);
  counts_ = state.counts;
}

}  // namespace ashlar

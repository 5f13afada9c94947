#include "solver/paths/pushover.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "mechanics/contact/contact_kinematics.hpp"
#include "solver/paths/pushed_blocks.hpp"
#include "solver/paths/pushover_activation.hpp"

namespace ashlar {
namespace {

/// Programmes of a path: ends one that shortens its steps indefinitely.
constexpr int most_push_programmes = 20000;
/// Places with positions and forces.
constexpr std::size_t most_states = 24;
/// Trials for a step that ends at a given value.
constexpr int most_place_trials = 24;
/// How near a multiplier of zero is met, relative to the first one: the line through the last two places has the rest.
constexpr double near_zero = 1e-6;
/// How near a displacement is met, relative to it.
constexpr double near_displacement = 1e-8;
/// Least motion of the control, of that of the block that moves farthest: in the first mechanism, and in a step, after which
/// it has advanced. With less, displacements are too small to control the path.
constexpr double control_moves = 1e-6, control_advances = 1e-3;
/// Ratio of a second trial to a step that has not reached a displacement it had reached before.
constexpr double longer_trial = 1.2;

/// A place that the path can return to.
struct Visited {
  FollowedPlace placement;
  double length = 0.0;  ///< m, of the step from here; 0: none
};

/// Blocks along a push.
class PushoverPath {
 public:
  PushoverPath(const PlacedScene& scene, const PushoverSearch& search, const PathLengths& lengths)
      : scene_(scene),
        search_(search),
        lengths_(lengths),
        direction_(search.direction.normalized()),
        pushed_(scene, search, lengths) {}

  Pushover follow() {
    if (begin()) {
      take_steps();
      if (path_.zero) add_shares();
      add_states();
    }
    path_.programmes = pushed_.programmes();
    return std::move(path_);
  }

 private:
  bool begin() {
    here_ = pushed_.start();
    if (!here_) {
      path_.end = end_at_start();
      return false;
    }
    // Blocks that a push against it alone would hold.
    if (!(here_->multiplier > 0.0)) {
      path_.end = PushoverEnd::not_balanced;
      return false;
    }
    const std::vector<int> moving = pushed_.blocks().moving_blocks(here_->model, here_->velocity);
    moving_first_ = moving;
    const double rate = control_rate();
    if (!(rate > control_moves)) {
      path_.end = PushoverEnd::control_at_rest;
      return false;
    }
    for (const int block : moving)
      path_.mechanism.push_back({block, weight_of(block), rate_of(block) / rate});
    note_place(*here_);
    return true;
  }

  [[nodiscard]] PushoverEnd end_at_start() const {
    switch (pushed_.failure()) {
      case PushFailure::jammed:
        return PushoverEnd::immovable;
      case PushFailure::unbalanced:
        return PushoverEnd::not_balanced;
      case PushFailure::far:
      case PushFailure::undetermined:
        break;
    }
    return PushoverEnd::not_determined;
  }

  [[nodiscard]] const BlockModel& block(int index) const { return scene_.system.blocks()[at(index)]; }

  [[nodiscard]] double weight_of(int index) const {
    return block(index).mass() * scene_.system.settings().gravity_at(scene_.end_time).norm();
  }

  /// Velocity of a block's centroid along the direction in the present mechanism.
  [[nodiscard]] double rate_of(int index) const {
    const Eigen::MatrixX3d& position = here_->placement.states[at(index)].position;
    const Vector3 centroid = PlacedBlock(block(index), position).place(block(index).basis().centroid());
    return velocity_at(here_->model, here_->velocity, index, centroid).dot(direction_);
  }

  [[nodiscard]] double control_rate() const {
    if (search_.control) {
      const auto& [index, point] = *search_.control;
      const Eigen::MatrixX3d& position = here_->placement.states[at(index)].position;
      return velocity_at(here_->model, here_->velocity, index,
                         PlacedBlock(block(index), position).place(point))
          .dot(direction_);
    }
    return weighted_mean([this](int index) { return rate_of(index); });
  }

  /// Mean over the blocks that move first, weighted by mass.
  template <class Value>
  [[nodiscard]] double weighted_mean(const Value& value) const {
    double sum = 0.0, mass = 0.0;
    for (const int index : moving_first_) {
      sum += block(index).mass() * value(index);
      mass += block(index).mass();
    }
    return mass > 0.0 ? sum / mass : 0.0;
  }

  /// Displacement of the control along the direction, m.
  [[nodiscard]] double displacement_of(const FollowedPlace& placement) const {
    const auto moved = [&](int index, const Vector3& point) {
      const PlacedBlock now(block(index), placement.states[at(index)].position);
      const PlacedBlock before(block(index), scene_.states[at(index)].position);
      return (now.place(point) - before.place(point)).dot(direction_);
    };
    if (search_.control) return moved(search_.control->block, search_.control->point);
    return weighted_mean([&](int index) { return moved(index, block(index).basis().centroid()); });
  }

  [[nodiscard]] PushoverPlace described(const PushedPlace& place) const {
    return {displacement_of(place.placement), place.multiplier,
            pushed_.blocks().moving_blocks(place.model, place.velocity)};
  }

  void note_place(const PushedPlace& place) {
    path_.places.push_back(described(place));
    visited_.push_back({place.placement, 0.0});
  }

  void go_on_to(PushedPlace next, double length) {
    visited_.back().length = length;
    note_place(next);
    here_ = std::move(next);
  }

  void take_steps() {
    double length = lengths_.longest_step;
    while (true) {
      if (!search_.may_continue()) {
        path_.end = PushoverEnd::interrupted;
        return;
      }
      std::optional<PushedPlace> next;
      if (pushed_.programmes() < most_push_programmes) next = pushed_.advanced(*here_, length);
      if (!next) {
        if (length <= lengths_.closed || pushed_.programmes() >= most_push_programmes) {
          path_.end = end_of_failure();
          return;
        }
        length = std::max(pushed_.failure() == PushFailure::far ? next_length(length, 0.5) : 0.5 * length,
                          0.5 * lengths_.closed);
        continue;
      }
      if (ends(*next, length)) return;
      if (rests(displacement_of(next->placement), length)) {
        path_.end = PushoverEnd::control_at_rest;
        return;
      }
      const double longer = next_length(length, 2.0);
      go_on_to(std::move(*next), length);
      length = std::min(lengths_.longest_step, longer);
    }
  }

  /// True if blocks have moved on by the limit of the search while the control has not. @param displacement m, of it
  bool rests(double displacement, double length) {
    if (displacement > farthest_ + control_advances * length) {
      farthest_ = displacement;
      travel_at_rest_ = 0.0;
    } else {
      travel_at_rest_ += length;
    }
    return travel_at_rest_ > search_.limit;
  }

  /// @param most factor
  [[nodiscard]] double next_length(double length, double most) const {
    return lengths_.next_step(length, pushed_.last_travel(), most);
  }

  [[nodiscard]] PushoverEnd end_of_failure() {
    switch (pushed_.failure()) {
      case PushFailure::jammed:
        return PushoverEnd::jams;
      case PushFailure::far:
        return PushoverEnd::collapses;
      case PushFailure::unbalanced:
      case PushFailure::undetermined:
        break;
    }
    double largest = 0.0;
    for (const PushoverPlace& place : path_.places) largest = std::max(largest, std::abs(place.multiplier));
    return pushed_.falls_at_failure(largest) ? PushoverEnd::collapses : PushoverEnd::not_determined;
  }

  /// Ends the path at a zero of the multiplier or at the limit, if the next place is beyond one of them.
  bool ends(PushedPlace& next, double length) {
    const double first = path_.places.front().multiplier;
    if (!(next.multiplier > 0.0)) {
      PushedPlace last = met(length, std::move(next), near_zero * first,
                             [](const PushedPlace& place) { return place.multiplier; });
      go_on_to(std::move(last), length);
      note_zero();
      path_.end = PushoverEnd::zero;
      return true;
    }
    if (displacement_of(next.placement) < search_.limit) return false;
    PushedPlace last =
        met(length, std::move(next), near_displacement * search_.limit,
            [&](const PushedPlace& place) { return search_.limit - displacement_of(place.placement); });
    go_on_to(std::move(last), length);
    path_.end = PushoverEnd::reaches_limit;
    return true;
  }

  /// The displacement of a multiplier of zero, by the line through the last two places.
  void note_zero() {
    const PushoverPlace& last = path_.places.back();
    const PushoverPlace& before = path_.places[path_.places.size() - 2];
    path_.zero = last.displacement + last.multiplier * (last.displacement - before.displacement) /
                                         (before.multiplier - last.multiplier);
  }

  /// The place between here and one beyond at which a value is zero: the best of some trials by the rule of false position
  /// (Illinois). @param value > 0 here, at most 0 beyond
  template <class Value>
  [[nodiscard]] PushedPlace met(double length, PushedPlace beyond, double tolerance, const Value& value) {
    double low = 0.0, high = length, at_low = value(*here_), at_high = value(beyond);
    double best = std::abs(at_high);
    int side = 0;  // that was moved last
    for (int n = 0; n < most_place_trials && best > tolerance; ++n) {
      const double trial = low + (high - low) * at_low / (at_low - at_high);
      if (!(trial > low && trial < high)) break;
      std::optional<PushedPlace> found = pushed_.advanced(*here_, trial);
      if (!found) break;
      const double of = value(*found);
      if (of > 0.0) {
        if (std::exchange(side, 1) == 1) at_high *= 0.5;
        low = trial;
        at_low = of;
      } else {
        if (std::exchange(side, -1) == -1) at_low *= 0.5;
        high = trial;
        at_high = of;
      }
      if (std::abs(of) < best) {
        best = std::abs(of);
        beyond = std::move(*found);
      }
    }
    return beyond;
  }

  /// Adds places at shares of the displacement of the zero.
  void add_shares() {
    for (const double share : search_.shares) add_displacement(share * *path_.zero);
  }

  void add_displacement(double displacement) {
    const double tolerance = near_displacement * *path_.zero;
    for (std::size_t k = 0; k + 1 < path_.places.size(); ++k) {
      const double before = path_.places[k].displacement, after = path_.places[k + 1].displacement;
      if (std::abs(displacement - before) <= tolerance || std::abs(displacement - after) <= tolerance) return;
      if (!(before < displacement && displacement < after)) continue;
      here_ = pushed_.equilibrium_from(visited_[k].placement, lengths_.farthest);
      if (!here_) return;
      // Steps are lengths of a block's way, which depends a little on earlier ones.
      double length = visited_[k].length;
      const auto left = [&](const PushedPlace& place) {
        return displacement - displacement_of(place.placement);
      };
      std::optional<PushedPlace> beyond = pushed_.advanced(*here_, length);
      if (beyond && left(*beyond) > 0.0) beyond = pushed_.advanced(*here_, length *= longer_trial);
      if (!beyond || left(*beyond) > 0.0) return;
      const PushedPlace found = met(length, std::move(*beyond), tolerance, left);
      const auto next = static_cast<std::ptrdiff_t>(k + 1);
      path_.places.insert(path_.places.begin() + next, described(found));
      visited_.insert(visited_.begin() + next, {found.placement, length});
      return;
    }
  }

  /// Positions and forces of some places.
  void add_states() {
    const std::size_t count = path_.places.size();
    const std::size_t shown = std::min(count, most_states);
    for (std::size_t n = 0; n < shown; ++n) {
      const std::size_t k = shown > 1 ? n * (count - 1) / (shown - 1) : 0;
      const std::optional<PushedPlace> place =
          pushed_.equilibrium_from(visited_[k].placement, lengths_.farthest);
      if (!place) continue;
      PushoverState state;
      state.place = static_cast<int>(k);
      for (const BlockState& of : place->placement.states) state.positions.push_back(of.position);
      state.contacts = contact_records(place->model, in_newtons(place->model, place->force));
      path_.states.push_back(std::move(state));
    }
  }

  const PlacedScene& scene_;
  const PushoverSearch& search_;
  PathLengths lengths_;
  Vector3 direction_;  ///< unit
  PushedBlocks pushed_;
  std::vector<int> moving_first_;  ///< blocks
  std::optional<PushedPlace> here_;
  std::vector<Visited> visited_;  ///< by place
  double farthest_ = 0.0;         ///< m, largest displacement of the control
  double travel_at_rest_ = 0.0;   ///< m, path of the fastest blocks since then
  Pushover path_;
};

}  // namespace

Pushover pushover(const PlacedScene& scene, const PushoverSearch& search) {
  RunState placed;
  placed.states = scene.states;
  for (const auto& [blocks, history] : scene.histories) placed.pairs[blocks].overlap = history.overlap;
  const RigidModel model = rigid_model(scene.system, placed, scene.end_time, search.multiplied);
  const std::vector<Bolt>& bolts = scene.system.bolts();
  if (std::any_of(bolts.begin(), bolts.end(), [](const Bolt& bolt) { return bolt.installed; }))
    throw std::invalid_argument("bolts and props do not follow a pushover");
  if (model.bodies.empty()) throw std::invalid_argument("no block can move");
  if (block_held_in_part(model)) throw std::invalid_argument("supports hold a block in part");
  if (!(scene.system.settings().gravity_at(scene.end_time).norm() > 0.0))
    throw std::invalid_argument("there is no gravity");
  const PathLengths lengths(smallest_size(scene.system, model), scene.system.settings().contact_distance);
  Pushover path = PushoverPath(scene, search, lengths).follow();
  path.left_out_strength = std::any_of(model.points.begin(), model.points.end(), [](const RigidPoint& point) {
    return point.law.cohesion > 0.0 || point.law.tensile_strength > 0.0;
  });
  if (!path.places.empty() && path.end != PushoverEnd::interrupted) {
    if (const auto first = pushover_activation(scene, search, path.places.front().multiplier)) {
      path.activation = first->multiplier;
      path.at_limit = first->at_limit;
    } else {
      path.end = PushoverEnd::interrupted;
    }
  }
  return path;
}

std::optional<double> multiplier_at(const Pushover& path, double displacement) {
  const std::vector<PushoverPlace>& places = path.places;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const double before = places[k].displacement, after = places[k + 1].displacement;
    if (!(before <= displacement && displacement <= after && before < after)) continue;
    const double share = (displacement - before) / (after - before);
    return (1.0 - share) * places[k].multiplier + share * places[k + 1].multiplier;
  }
  return std::nullopt;
}

const char* to_string(PushoverEnd end) {
  switch (end) {
    case PushoverEnd::zero:
      return "zero";
    case PushoverEnd::reaches_limit:
      return "reaches-limit";
    case PushoverEnd::collapses:
      return "collapses";
    case PushoverEnd::jams:
      return "jams";
    case PushoverEnd::immovable:
      return "immovable";
    case PushoverEnd::not_balanced:
      return "not-balanced";
    case PushoverEnd::control_at_rest:
      return "control-at-rest";
    case PushoverEnd::not_determined:
      return "not-determined";
    case PushoverEnd::interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace ashlar

#include "solver/paths/path_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ashlar {
namespace {

/// Shares of the associated limit at which the path is tried first.
constexpr std::array shares = {0.3, 0.5, 0.65, 0.8, 0.95};
/// Ratio of factors where no limit is known.
constexpr double path_stride = 1.5;
/// Relative accuracy of the onset, and the finest one.
constexpr double onset_accuracy = 0.01;
constexpr int most_path_trials = 60;
/// Trials and ratio of the compressive strengths between which the least one is.
constexpr int most_strengths = 14;
/// Bodies up to which the compressive strength is searched: each trial lets joints yield point by point.
constexpr std::size_t most_bodies_of_strength = 40;
constexpr double strength_accuracy = 1.05;
/// Strength factor at the start of the path: with ten times their strength joints neither slide nor tear, unless blocks
/// would wedge at any friction that there is.
constexpr double nothing_slides = 0.1;
/// Pressure of the most pressed joint at the least strength, of that strength: forces of the path have about this accuracy.
constexpr double reaches_strength = 1.0 - 1e-6;
/// Trial of the onset below a bracket that has no lower end, of its upper end, at most.
constexpr double below_bracket = 0.9;

/// Search along one path.
class PathSearch {
 public:
  PathSearch(LoadPath& path, Sought sought, const LimitSearch& search, const LimitBracket& associated,
             const std::function<bool()>& may_continue)
      : path_(path), sought_(sought), search_(search), associated_(associated), may_continue_(may_continue) {}

  PathAnswer run() {
    if (!begin()) return std::move(answer_);
    for (int n = 0; n < most_path_trials; ++n) {
      const std::optional<double> next = next_factor();
      if (!next || !attempt(*next)) break;
    }
    if (!answer_.upper && associated_.upper && answer_.lower && answer_.lower == associated_.lower) {
      answer_.upper = associated_.upper;
      answer_.proven = true;
    }
    answer_.resolved = is_resolved();
    if (moves_) answer_.motion = path_.motion_of(*moves_, factors(*answer_.upper));
    if (answer_.lower) {
      const PathState& rest = rest_.rbegin()->second.end;
      answer_.displacement = rest.displacement;
      answer_.force = rest.force;
    }
    if (!answer_.interrupted) find_onset();
    const bool few = path_.model().bodies.size() <= most_bodies_of_strength;
    if (!answer_.interrupted && answer_.lower && few) find_strength();
    return std::move(answer_);
  }

 private:
  [[nodiscard]] LimitFactors factors(double factor) const {
    return sought_ == Sought::strength ? LimitFactors{factor, 1.0} : LimitFactors{1.0, factor};
  }

  /// The state at the start of the path. @return false if blocks move before it
  bool begin() {
    const LimitFactors first =
        sought_ == Sought::strength ? LimitFactors{nothing_slides, 1.0} : LimitFactors{1.0, 0.0};
    PathTrial trial = path_.to(path_.unloaded(), first);
    note(0.0, trial);
    if (trial.outcome == LimitOutcome::stands) {
      for (BodyVelocity& moved : trial.end.moved) moved.setZero();
      trial.end.displacement = 0.0;
      rest_.emplace(0.0, std::move(trial));
      return true;
    }
    answer_.upper = search_.lower;
    answer_.resolved = true;
    answer_.proven = trial.outcome == LimitOutcome::moves;
    if (answer_.proven) answer_.motion = path_.motion_of(trial, first);
    return false;
  }

  void note(double factor, const PathTrial& trial) {
    LimitTrial& kept = answer_.trials.emplace_back();
    kept.factors = factors(factor);
    kept.outcome = trial.outcome;
    kept.iterations = trial.iterations;
  }

  /// @return false if the search ends
  bool attempt(double factor) {
    if (!may_continue_()) {
      answer_.interrupted = true;
      return false;
    }
    const auto& [from, start] = *rest_.rbegin();
    PathTrial trial = path_.to(start.end, factors(factor));
    note(factor, trial);
    if (trial.outcome == LimitOutcome::stands) {
      answer_.lower = factor;
      rest_.emplace(factor, std::move(trial));
      return true;
    }
    answer_.upper = factor;
    answer_.proven = trial.outcome == LimitOutcome::moves;
    moves_.reset();
    if (answer_.proven) moves_ = std::move(trial);
    return true;
  }

  [[nodiscard]] bool is_resolved() const {
    if (answer_.lower && answer_.upper) return *answer_.upper <= *answer_.lower * (1.0 + search_.tolerance);
    return answer_.lower ? *answer_.lower >= search_.upper : answer_.upper && *answer_.upper <= search_.lower;
  }

  [[nodiscard]] std::optional<double> next_factor() const {
    const double low = answer_.lower.value_or(0.0);
    const double most = std::min(search_.upper, associated_.lower.value_or(search_.upper));
    if (answer_.upper) {
      if (!answer_.lower)
        return *answer_.upper > search_.lower
                   ? std::optional(std::max(*answer_.upper / path_stride, search_.lower))
                   : std::nullopt;
      if (*answer_.upper <= *answer_.lower * (1.0 + search_.tolerance)) return std::nullopt;
      return std::sqrt(*answer_.lower * *answer_.upper);
    }
    if (associated_.lower) {
      for (const double share : shares)
        if (low < share * *associated_.lower && share * *associated_.lower > search_.lower)
          return std::min(share * *associated_.lower, search_.upper);
      if (low < most) return most;
      // The path stands as far as any forces do.
      return std::nullopt;
    }
    if (low >= search_.upper) return std::nullopt;
    return low == 0.0 ? search_.lower : std::min(path_stride * low, search_.upper);
  }

  /// Lets the compressive strength of all joints fall at `lower`, from that which no point reaches.
  void find_strength() {
    PathState state = rest_.rbegin()->second.end;
    double stands = path_.largest_pressure(state), moves = 0.0;
    if (!(stands > 0.0)) return;
    for (int n = 0;
         n < most_strengths && !(moves > 0.0 && stands <= strength_accuracy * moves) && may_continue_();
         ++n) {
      const double next = moves > 0.0 ? std::sqrt(stands * moves) : 0.5 * stands;
      PathTrial trial = path_.to(state, factors(*answer_.lower), next);
      if (trial.outcome == LimitOutcome::stands) {
        stands = next;
        state = std::move(trial.end);
      } else {
        moves = next;
      }
    }
    answer_.least_strength = stands;
    answer_.strength_joint = path_.most_pressed(state, reaches_strength * stands);
  }

  void find_onset() {
    const PathState& start = rest_.begin()->second.end;
    const auto yields = [&](const PathTrial& trial) { return path_.yielding_joints(start, trial); };
    auto after = std::find_if(std::next(rest_.begin()), rest_.end(),
                              [&](const auto& one) { return !yields(one.second).empty(); });
    double low = std::prev(after)->first, high = 0.0;
    PathTrial before = std::prev(after)->second, first;
    if (after == rest_.end()) {
      if (!answer_.upper) return;
      high = *answer_.upper;
      first = before;
    } else {
      high = after->first;
      first = after->second;
    }
    const double accuracy = std::max(onset_accuracy, search_.tolerance);
    while (after != rest_.end() && high > low * (1.0 + accuracy) && may_continue_()) {
      const double middle = low > 0.0 ? std::sqrt(low * high)
                                      : std::max(0.5 * high, std::min(search_.lower, below_bracket * high));
      PathTrial trial = path_.to(before.end, factors(middle));
      if (trial.outcome == LimitOutcome::stands && yields(trial).empty()) {
        low = middle;
        before = std::move(trial);
      } else {
        high = middle;
        first = std::move(trial);
      }
      if (high <= search_.lower && low == 0.0) break;
    }
    answer_.onset = low > 0.0 ? low : high;
    answer_.onset_displacement = before.end.displacement;
    answer_.onset_joints = yields(first);
  }

  LoadPath& path_;
  Sought sought_;
  const LimitSearch& search_;
  const LimitBracket& associated_;
  const std::function<bool()>& may_continue_;
  PathAnswer answer_;
  std::optional<PathTrial> moves_;    ///< at `upper`
  std::map<double, PathTrial> rest_;  ///< by factor, states at rest in the order of the path; 0: its start
};

}  // namespace

PathAnswer search_path(LoadPath& path, Sought sought, const LimitSearch& search,
                       const LimitBracket& associated, const std::function<bool()>& may_continue) {
  return PathSearch(path, sought, search, associated, may_continue).run();
}

}  // namespace ashlar

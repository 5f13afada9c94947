#include "solver/limit/limit_trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

constexpr int most_trials = 80, most_unknown = 6;
/// A trial without an outcome is repeated at a smaller factor, at first by this share of the tolerance, then farther by a
/// ratio: smaller shares repeat the same rounding errors, larger ones shift the limit that is found.
constexpr double unknown_offset = 0.1, unknown_ratio_of_offsets = 4.0;
/// Ratio of factors where no upper bound is known: a smaller one needs more trials, a larger one a wider bracket.
constexpr double upward_stride = 2.0;
/// Distance of a trial above an estimated limit, of the tolerance (see below_estimate), and the least one from both ends
/// of the bracket: nearer trials hardly narrow it.
constexpr double above_estimate = 0.5, from_ends = 0.2;
/// Largest width of a bracket relative to the one before, as logarithms, for which estimates are used: bisection has 0.5.
constexpr double narrowing = 0.7;

class Bracketing {
 public:
  Bracketing(const LimitSearch& search, LimitBracket& bracket, double guess, double stride)
      : search_(search), bracket_(bracket), estimate_(guess), stride_(stride) {}

  void run(double first, const LimitAttempt& attempt) {
    double next = within(first);
    int unknown = 0;
    for (int n = 0; n < most_trials && next > 0.0; ++n) {
      std::optional<LimitTrial> trial = attempt(next);
      if (!trial) return;
      if (trial->outcome == LimitOutcome::unknown) {
        if (++unknown > most_unknown) return;
        // Rounding differs at a factor beside it.
        next = within(next * (1.0 - unknown_offset * search_.tolerance *
                                        correctly_rounded::pow(unknown_ratio_of_offsets, unknown - 1)));
        continue;
      }
      note(next, std::move(*trial));
      next = next_factor();
    }
  }

 private:
  [[nodiscard]] double within(double factor) const {
    return std::clamp(factor, search_.lower, search_.upper);
  }

  void note(double factor, LimitTrial trial) {
    const bool stands = trial.outcome == LimitOutcome::stands;
    if (!stands) estimate_ = trial.estimate;
    last_stands_ = stands;
    std::optional<double>& end = stands ? bracket_.lower : bracket_.upper;
    if (end && (stands ? factor <= *end : factor >= *end)) return;
    end = factor;
    if (!stands) bracket_.motion = std::move(trial);
  }

  /// @return 0 if the bracket is narrow enough
  double next_factor() {
    const auto& [low, high] = std::pair(bracket_.lower, bracket_.upper);
    if (!high) {
      bracket_.resolved = *low >= search_.upper;
      if (bracket_.resolved) return 0.0;
      const double above = std::exchange(estimate_, 0.0) * (1.0 + above_estimate * search_.tolerance);
      return std::min(above > *low ? above : upward_stride * *low, search_.upper);
    }
    bracket_.resolved = low ? *high <= *low * (1.0 + search_.tolerance) : *high <= search_.lower;
    if (bracket_.resolved) return 0.0;
    const double least = low ? *low : search_.lower;
    const double farthest = std::max(least, *high / stride_);
    const double estimated = estimated_factor(least, *high);
    if (estimated > 0.0) return std::max(estimated, farthest);
    return std::max(low ? std::sqrt(*low * *high) : farthest, farthest);
  }

  /// Factor beside the estimate of the last motion, on the side that has not been tried. Estimates that do not narrow
  /// the bracket are not used. @return 0: none
  double estimated_factor(double least, double high) {
    const double width = correctly_rounded::log(high / least);
    const bool helps = width < narrowing * std::exchange(width_, width);
    if (!helps && std::exchange(estimated_last_, false)) return 0.0;
    const double below = estimate_ * (1.0 - below_estimate * search_.tolerance),
                 above = estimate_ * (1.0 + above_estimate * search_.tolerance);
    const double apart = 1.0 + from_ends * search_.tolerance;
    const double near = last_stands_ || below <= least * apart ? above : below;
    if (estimate_ <= 0.0 || near <= least * apart || near >= high / apart) return 0.0;
    if (last_stands_) estimate_ = 0.0;
    estimated_last_ = true;
    return near;
  }

  const LimitSearch& search_;
  LimitBracket& bracket_;
  double estimate_;
  double stride_;
  double width_ = INFINITY;
  bool last_stands_ = false;
  bool estimated_last_ = false;
};

}  // namespace

void narrow(LimitBracket& bracket, const LimitSearch& search, double first, double guess, double stride,
            const LimitAttempt& attempt) {
  Bracketing(search, bracket, guess, stride).run(first, attempt);
}

const char* to_string(LimitOutcome outcome) {
  switch (outcome) {
    case LimitOutcome::stands:
      return "stands";
    case LimitOutcome::moves:
      return "moves";
    case LimitOutcome::unknown:
      return "unknown";
  }
  return "";
}

}  // namespace ashlar

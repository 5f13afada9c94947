#include "solver/limit/limit_trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ashlar {
namespace {

constexpr int most_trials = 80, most_unknown = 6;

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
        next = within(next * (1.0 - 0.1 * search_.tolerance * std::pow(4.0, unknown - 1)));
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
      const double above = std::exchange(estimate_, 0.0) * (1.0 + 0.5 * search_.tolerance);
      return std::min(above > *low ? above : 2.0 * *low, search_.upper);
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
    const double width = std::log(high / least);
    const bool helps = width < 0.7 * std::exchange(width_, width);
    if (!helps && std::exchange(estimated_last_, false)) return 0.0;
    const double below = estimate_ * (1.0 - 0.3 * search_.tolerance),
                 above = estimate_ * (1.0 + 0.5 * search_.tolerance);
    const double apart = 1.0 + 0.2 * search_.tolerance;
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

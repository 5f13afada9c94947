#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "solver/limit/limit_analysis.hpp"

namespace ashlar {
namespace {

/// Ratio of the factor of a motion to the next smaller one at which it is searched.
constexpr double stride = 1.25, short_stride = 1.03, associated_stride = 2.0;
/// Largest number of searches for a motion below a factor that was found to stand.
constexpr int most_returns = 30;

/// The search for both limits of strengths or of loads.
class LimitSearching {
 public:
  LimitSearching(LimitAnalysis& analysis, Sought sought, const LimitSearch& search,
                 const std::function<bool()>& may_continue, const LimitAnalysis::OtherMotion& other)
      : analysis_(analysis), sought_(sought), search_(search), may_continue_(may_continue), other_(other) {}

  LimitAnswer run() {
    const double guess = sought_ == Sought::load ? analysis_.most_that_stands(search_.upper) : 0.0;
    const double first = guess > 0.0 ? guess * (1.0 - below_estimate * search_.tolerance) : 1.0;
    narrow(answer_.associated, search_, first, guess, associated_stride,
           [&](double factor) { return attempt(factor, false); });
    if (!answer_.interrupted) {
      const std::optional<LimitTrial> other = other_ ? other_(answer_.associated) : std::nullopt;
      look_below(other);
    }
    if (!answer_.interrupted && answer_.released.lower)
      answer_.kept_by_others = analysis_.moving_alone(factors(*answer_.released.lower), search_.tolerance);
    return std::move(answer_);
  }

 private:
  [[nodiscard]] LimitFactors factors(double factor) const {
    return sought_ == Sought::strength ? LimitFactors{factor, 1.0} : LimitFactors{1.0, factor};
  }

  /// The released motion to follow. One under larger loads has no relation to the motion when smaller ones are added
  /// to the steady ones. @return null: none
  [[nodiscard]] const LimitTrial* known() const {
    const std::optional<LimitTrial>& motion = answer_.released.motion;
    return sought_ == Sought::strength && motion && motion->released ? &*motion : nullptr;
  }

  std::optional<LimitTrial> attempt(double factor, bool released) {
    if (!may_continue_()) {
      answer_.interrupted = true;
      return std::nullopt;
    }
    if (released) followed_[factor] = known() != nullptr ? known()->factors.strength : 0.0;
    // Forces in balance with smaller strengths are in balance with larger ones too.
    const bool balanced = sought_ == Sought::strength && factor <= answer_.associated.lower.value_or(0.0);
    LimitTrial trial = released ? analysis_.released(factors(factor), search_.tolerance, known(), balanced)
                                : analysis_.associated(factors(factor));
    if (sought_ == Sought::load) trial.estimate = 0.0;
    LimitTrial& kept = answer_.trials.emplace_back(trial);
    kept.acceleration.clear();
    kept.force.clear();
    return trial;
  }

  void narrow_released(double first, double most_stride) {
    narrow(answer_.released, search_, first, 0.0, most_stride,
           [&](double factor) { return attempt(factor, true); });
  }

  /// Searches for a released motion below the associated limit: at the largest factor that stands, and downwards.
  /// @param other motion, from which the search begins if it is below that
  void look_below(const std::optional<LimitTrial>& other) {
    const LimitBracket& associated = answer_.associated;
    LimitBracket& released = answer_.released;
    released.upper = associated.upper;
    released.motion = associated.motion;
    if (!associated.lower) {
      released.resolved = associated.resolved;
      return;
    }
    double first = *associated.lower;
    if (other) {
      const double factor = sought_ == Sought::strength ? other->factors.strength : other->factors.load;
      if (factor <= search_.lower) {
        released.upper = factor;
        released.motion = other;
        released.resolved = true;
        return;
      }
      if (factor < first) {
        released.upper = factor;
        released.motion = other;
        first = std::max(factor / (1.0 + search_.tolerance), search_.lower);
      }
    }
    narrow_released(first, stride);
    int n = 0;
    for (; n < most_returns && moves_at_lower(); ++n) {
      released.upper = std::exchange(released.lower, std::nullopt);
      released.resolved = false;
      narrow_released(*released.upper / (1.0 + search_.tolerance), short_stride);
    }
    if (n == most_returns) released.resolved = false;
  }

  /// Repeats the trial of a standing factor from the last motion, in case the search had followed a motion far above it.
  bool moves_at_lower() {
    LimitBracket& released = answer_.released;
    if (!released.resolved || !released.lower || !released.upper) return false;
    if (known() == nullptr || followed_[*released.lower] == *released.upper) return false;
    std::optional<LimitTrial> again = attempt(*released.lower, true);
    if (!again || again->outcome != LimitOutcome::moves) return false;
    released.motion = std::move(again);
    return true;
  }

  LimitAnalysis& analysis_;
  Sought sought_;
  const LimitSearch& search_;
  const std::function<bool()>& may_continue_;
  const LimitAnalysis::OtherMotion& other_;
  LimitAnswer answer_;
  std::map<double, double> followed_;  ///< by factor, that of the motion at the start of its trial; 0: none
};

}  // namespace

LimitAnswer LimitAnalysis::strength_factor(const LimitSearch& search,
                                           const std::function<bool()>& may_continue,
                                           const OtherMotion& other) {
  return LimitSearching(*this, Sought::strength, search, may_continue, other).run();
}

LimitAnswer LimitAnalysis::load_factor(const LimitSearch& search, const std::function<bool()>& may_continue,
                                       const OtherMotion& other) {
  return LimitSearching(*this, Sought::load, search, may_continue, other).run();
}

}  // namespace ashlar

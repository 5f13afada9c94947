#include "apps/run/factor_search.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

class Search {
 public:
  Search(const SceneAnalysis::FactorSearch& range,
         const std::function<std::optional<FactorTrial>(double)>& attempt)
      : range_(range), attempt_(attempt) {}

  FactorBracket run(const std::optional<ExpectedFactor>& expected) {
    const double low = std::clamp(expected ? expected->lower : 1.0, range_.lower, range_.upper);
    const double high = std::clamp(expected ? expected->upper : 1.0, range_.lower, range_.upper);
    bool goes_on = decide(low) && (high == low || decide(high));
    for (double factor = low; goes_on && !bracket_.lower && factor > range_.lower;)
      goes_on = decide(factor = std::max(factor / 2.0, range_.lower));
    for (double factor = high; goes_on && !bracket_.upper && factor < range_.upper;)
      goes_on = decide(factor = std::min(2.0 * factor, range_.upper));
    while (goes_on && bracket_.lower && bracket_.upper &&
           *bracket_.upper > *bracket_.lower * (1.0 + range_.tolerance)) {
      const std::optional<double> next = middle();
      if (!next || *next <= *bracket_.lower || *next >= *bracket_.upper) break;  // neighbouring numbers
      goes_on = decide(*next);
    }
    bracket_.resolved = goes_on && resolved();
    return bracket_;
  }

 private:
  [[nodiscard]] bool resolved() const {
    if (bracket_.lower && bracket_.upper)
      return *bracket_.upper <= std::max(*bracket_.lower * (1.0 + range_.tolerance),
                                         std::nextafter(*bracket_.lower, *bracket_.upper));
    return bracket_.lower == range_.upper || bracket_.upper == range_.lower;
  }

  /// The middle of the remaining bracket: of all of it, or of the wider part below or above the inconclusive factors.
  /// Empty if those are within a quarter of the tolerance of either end.
  [[nodiscard]] std::optional<double> middle() const {
    double first = *bracket_.upper, last = *bracket_.lower;  // inconclusive factors
    for (const FactorTrial& trial : bracket_.trials)
      if (trial.outcome == TrialOutcome::unknown && trial.factor > *bracket_.lower &&
          trial.factor < *bracket_.upper) {
        first = std::min(first, trial.factor);
        last = std::max(last, trial.factor);
      }
    if (first > last) return std::sqrt(*bracket_.lower * *bracket_.upper);
    const double below = first / *bracket_.lower, above = *bracket_.upper / last;
    if (std::max(below, above) <= 1.0 + range_.tolerance / 4.0) return std::nullopt;
    return below > above ? *bracket_.lower * std::sqrt(below) : last * std::sqrt(above);
  }

  /// @return false if the search was interrupted
  bool decide(double factor) {
    const std::optional<FactorTrial> trial = attempt_(factor);
    bracket_.interrupted = !trial;
    if (!trial) return false;
    bracket_.trials.push_back(*trial);
    if (trial->outcome == TrialOutcome::stands)
      bracket_.lower = std::max(bracket_.lower.value_or(factor), factor);
    if (trial->outcome == TrialOutcome::moves)
      bracket_.upper = std::min(bracket_.upper.value_or(factor), factor);
    return true;
  }

  const SceneAnalysis::FactorSearch& range_;
  const std::function<std::optional<FactorTrial>(double)>& attempt_;
  FactorBracket bracket_;
};

}  // namespace

std::string to_string(TrialOutcome outcome) {
  switch (outcome) {
    case TrialOutcome::stands:
      return "stands";
    case TrialOutcome::moves:
      return "moves";
    case TrialOutcome::unknown:
      return "unknown";
  }
  return "unknown";
}

FactorBracket find_factor(const SceneAnalysis::FactorSearch& search,
                          const std::function<std::optional<FactorTrial>(double)>& attempt,
                          const std::optional<ExpectedFactor>& expected) {
  return Search(search, attempt).run(expected);
}

}  // namespace ashlar

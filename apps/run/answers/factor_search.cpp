#include "apps/run/answers/factor_search.hpp"

#include <algorithm>
#include <cmath>

namespace ashlar {
namespace {

bool is_smaller(const FactorTrial& a, const FactorTrial& b) {
  return a.factor < b.factor;
}

}  // namespace

FactorSearch::FactorSearch(const SceneAnalysis::FactorSearch& range,
                           const std::optional<ExpectedFactor>& expected)
    : range_(range),
      low_(std::clamp(expected ? expected->lower : 1.0, range_.lower, range_.upper)),
      high_(std::clamp(expected ? expected->upper : 1.0, range_.lower, range_.upper)) {}

std::optional<double> FactorSearch::next() const {
  const std::vector<FactorTrial>& trials = bracket_.trials;
  if (trials.empty()) return low_;
  if (trials.size() == 1 && high_ != low_) return high_;
  const auto [least, largest] = std::minmax_element(trials.begin(), trials.end(), is_smaller);
  if (!bracket_.lower && least->factor > range_.lower) return std::max(least->factor / 2.0, range_.lower);
  if (!bracket_.upper && largest->factor < range_.upper) return std::min(2.0 * largest->factor, range_.upper);
  if (!bracket_.lower || !bracket_.upper || *bracket_.upper <= *bracket_.lower * (1.0 + range_.tolerance))
    return std::nullopt;
  const std::optional<double> factor = middle();
  const bool between = factor && *factor > *bracket_.lower && *factor < *bracket_.upper;
  return between ? factor : std::nullopt;  // neighbouring numbers have none between
}

void FactorSearch::add(const FactorTrial& trial) {
  bracket_.trials.push_back(trial);
  if (trial.outcome == TrialOutcome::stands)
    bracket_.lower = std::max(bracket_.lower.value_or(trial.factor), trial.factor);
  if (trial.outcome == TrialOutcome::moves)
    bracket_.upper = std::min(bracket_.upper.value_or(trial.factor), trial.factor);
}

FactorBracket FactorSearch::bracket() const {
  FactorBracket result = bracket_;
  result.resolved = !next() && resolved();
  return result;
}

bool FactorSearch::resolved() const {
  if (bracket_.lower && bracket_.upper)
    return *bracket_.upper <= std::max(*bracket_.lower * (1.0 + range_.tolerance),
                                       std::nextafter(*bracket_.lower, *bracket_.upper));
  return bracket_.lower == range_.upper || bracket_.upper == range_.lower;
}

/// The middle of the remaining bracket: of all of it, or of the wider part below or above the inconclusive factors.
/// Empty if those are within a quarter of the tolerance of either end.
std::optional<double> FactorSearch::middle() const {
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
  FactorSearch steps(search, expected);
  while (const std::optional<double> factor = steps.next()) {
    const std::optional<FactorTrial> trial = attempt(*factor);
    if (!trial) {
      FactorBracket stopped = steps.bracket();
      stopped.interrupted = true;
      return stopped;
    }
    steps.add(*trial);
  }
  return steps.bracket();
}

}  // namespace ashlar

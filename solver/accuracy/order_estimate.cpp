#include "solver/accuracy/order_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "geometry/exact/rounded_functions.hpp"
#include "geometry/index.hpp"
#include "solver/accuracy/goal_distance.hpp"

namespace ashlar {
namespace {

constexpr double unknown_error = std::numeric_limits<double>::infinity();

/// Errors of goals over rounds (notes/accuracy.md). Ratio of a change to that two rounds before: a smaller one may be chance
/// and would promise too little error, the sum of a slower series has no meaning; one for two rounds, which know none.
constexpr double least_ratio = 1.0 / 3.0, largest_ratio = 0.8, unknown_ratio = 0.5;
/// Exponent of the order by which the error at a corner or clamp falls: a larger one promises less error there than is left.
constexpr double corner_exponent = 3.0;
/// Orders and exponent from which on errors fall too slowly to be met (slow_error_at): lower ones end a choice early.
constexpr int least_slow_order = 6;
constexpr double fast_exponent = 3.5;
/// Lack of a block over that of the round before, from which on it hardly falls.
constexpr double slow_lack = 0.5;

double sum_over(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// True if the lacks of all moving blocks that deform are those of their next orders.
bool knows_next_orders(const AccuracyRound& round) {
  return !round.of_changes && std::none_of(round.missing_energy.begin(), round.missing_energy.end(),
                                           [](double lack) { return lack < 0.0; });
}

/// Rounds from the first one on in which a block deforms: supports may leave no motion to low orders, and nothing changes.
std::span<const AccuracyRound> from_deformed(std::span<const AccuracyRound> rounds) {
  const auto first = std::find_if(rounds.begin(), rounds.end(),
                                  [](const AccuracyRound& round) { return sum_over(round.energies) > 0.0; });
  return rounds.subspan(static_cast<std::size_t>(first - rounds.begin()));
}

/// Of a goal between a round and that two before, or the first one.
double change_over_two(std::span<const AccuracyRound> rounds, std::size_t round, std::size_t goal) {
  return goal_distance(rounds[round].goals[goal],
                       rounds[round - std::min<std::size_t>(round, 2)].goals[goal]);
}

/// Ratio of the last change to that two rounds before; empty: too few rounds, or nothing has changed.
std::optional<double> ratio_of_changes(std::span<const AccuracyRound> rounds, std::size_t goal) {
  if (rounds.size() < 5) return std::nullopt;
  const double change = change_over_two(rounds, rounds.size() - 1, goal);
  if (change == 0.0) return std::nullopt;
  return change / change_over_two(rounds, rounds.size() - 3, goal);
}

/// The rest of an error that falls like n^-exponent, over its change from order m to n.
double rest_over_change(int m, int n, double exponent) {
  return 1.0 / (correctly_rounded::pow(static_cast<double>(n) / m, exponent) - 1.0);
}

/// Highest chosen one; 0: unknown.
int highest_order(const AccuracyRound& round) {
  return round.orders.empty() ? 0 : *std::max_element(round.orders.begin(), round.orders.end());
}

/// Estimated distance of a goal to its limit. The ratio of two changes is bounded from below, as a change that is small by
/// chance is not the end, and from above, where the sum of what is left would have no meaning.
double distance_to_limit(std::span<const AccuracyRound> rounds, std::size_t goal) {
  const std::size_t last = rounds.size() - 1;
  const double change = change_over_two(rounds, last, goal);
  const int n = highest_order(rounds[last]);
  const int m = highest_order(rounds[last - std::min<std::size_t>(last, 2)]);
  const bool knows_orders = last >= 4 && m > 0 && n > m;
  double ratio = last < 3 ? unknown_ratio : least_ratio;
  if (const auto measured = ratio_of_changes(rounds, goal))
    ratio = std::clamp(*measured, knows_orders ? 0.0 : least_ratio, largest_ratio);
  const double series = ratio / (1.0 - ratio);
  return change * (knows_orders ? std::max(series, rest_over_change(m, n, corner_exponent)) : series);
}

}  // namespace

double relative_to(double error, const Goal& goal) {
  const double scale = std::max(goal_length(goal.values), goal.least);
  return error > 0.0 ? (scale > 0.0 ? error / scale : unknown_error) : 0.0;
}

double error_of_energy(const AccuracyRound& round) {
  double missing = 0.0;
  for (const double lack : round.missing_energy) missing += std::max(lack, 0.0);
  return missing > 0.0 ? missing / (sum_over(round.energies) + missing) : 0.0;
}

double order_error_of(const std::vector<AccuracyRound>& all, std::size_t index, const Goal& goal) {
  const std::span<const AccuracyRound> rounds = from_deformed(all);
  const double in_norm =
      knows_next_orders(all.back()) ? std::sqrt(error_of_energy(all.back())) : unknown_error;
  return rounds.size() > 2 ? std::min(in_norm, relative_to(distance_to_limit(rounds, index), goal)) : in_norm;
}

double slow_error_at(const std::vector<AccuracyRound>& all, std::size_t index, const Goal& goal, int order) {
  const std::span<const AccuracyRound> rounds = from_deformed(all);
  const std::optional<double> ratio = ratio_of_changes(rounds, index);
  if (!ratio) return 0.0;
  const std::size_t last = rounds.size() - 1;
  const int n = highest_order(rounds[last]), m = highest_order(rounds[last - 2]);
  const int before = highest_order(rounds[last - 4]);
  if (n < least_slow_order || m >= n || before >= m || before < 1) return 0.0;
  const auto error = [](int k) { return correctly_rounded::pow(k, -fast_exponent); };
  if (*ratio < (error(m) - error(n)) / (error(before) - error(m))) return 0.0;
  const double fall = correctly_rounded::pow(static_cast<double>(n) / order, corner_exponent);
  return fall * relative_to(distance_to_limit(rounds, index), goal);
}

int slow_block_of(const std::vector<AccuracyRound>& rounds) {
  if (rounds.size() < 2) return -1;
  const AccuracyRound& last = rounds.back();
  const AccuracyRound& before = rounds[rounds.size() - 2];
  const auto worst = std::max_element(last.missing_energy.begin(), last.missing_energy.end());
  const auto block = static_cast<std::size_t>(worst - last.missing_energy.begin());
  // A block that has kept its order has kept its lack.
  if (last.of_changes && last.orders[block] == before.orders[block]) return -1;
  return *worst > 0.0 && *worst > slow_lack * before.missing_energy[block] ? static_cast<int>(block) : -1;
}

void take_missing_energy_of_changes(const Simulation& simulation, const std::vector<AccuracyRound>& rounds,
                                    AccuracyRound& now) {
  const AccuracyRound& earlier = rounds[rounds.size() - 2];
  for (std::size_t k = 0; k < now.missing_energy.size(); ++k) {
    const BlockModel& block = simulation.blocks()[k];
    if (now.energies[k] == 0.0 || earlier.energies[k] == 0.0) continue;
    const Eigen::MatrixX3d& position = now.positions[k];
    Eigen::MatrixX3d before = Eigen::MatrixX3d::Zero(position.rows(), 3);
    before.topRows(earlier.positions[k].rows()) = earlier.positions[k];
    const int risen = now.orders[k] - earlier.orders[k];
    if (risen == 0) continue;
    const Eigen::MatrixX3d force = block.elastic(position).force - block.elastic(before).force;
    const double energy = 0.5 * std::abs(force.cwiseProduct(position - before).sum());
    if (risen >= 2)
      now.missing_energy[k] = energy;
    else if (now.missing_energy[k] >= 0.0)
      now.missing_energy[k] = std::max(energy, now.missing_energy[k]);
  }
}

}  // namespace ashlar

#include "solver/state/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "geometry/index.hpp"
#include "solver/state/run_state.hpp"

namespace ashlar {
namespace {

/// Values of each process.
std::vector<std::vector<double>> gathered(const BlockSystem& system, const std::vector<double>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  std::vector<std::vector<double>> all;
  for (const std::vector<std::byte>& given : system.exchange().gather({bytes.begin(), bytes.end()})) {
    all.emplace_back(given.size() / sizeof(double));
    if (!given.empty()) std::memcpy(all.back().data(), given.data(), given.size());
  }
  return all;
}

}  // namespace

std::vector<double> sum_of_run(const BlockSystem& system, const std::vector<double>& values) {
  if (system.exchange().alone()) return values;
  std::vector<double> sum(values.size(), 0.0);
  for (const std::vector<double>& part : gathered(system, values))
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
  return sum;
}

std::vector<double> most_of_run(const BlockSystem& system, const std::vector<double>& values) {
  if (system.exchange().alone()) return values;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> most(values.size(), -infinite);
  for (const std::vector<double>& part : gathered(system, values))
    for (std::size_t k = 0; k < most.size(); ++k)
      most[k] = std::isnan(part[k]) ? infinite : std::max(most[k], part[k]);
  return most;
}

std::vector<bool> any_of_run(const BlockSystem& system, const std::vector<bool>& flags) {
  if (system.exchange().alone() || flags.empty()) return flags;
  std::vector<double> values;
  values.reserve(flags.size());
  for (const bool flag : flags) values.push_back(flag ? 1.0 : 0.0);
  std::vector<bool> any;
  for (const double value : most_of_run(system, values)) any.push_back(value > 0.0);
  return any;
}

void sum_of_run(const BlockSystem& system, Eigen::MatrixXd& values) {
  if (system.exchange().alone() || values.size() == 0) return;
  const std::vector<double> sums =
      sum_of_run(system, std::vector<double>(values.data(), values.data() + values.size()));
  std::copy(sums.begin(), sums.end(), values.data());
}

void tell_states(const BlockSystem& system, RunState& state) {
  const bool accelerated = !state.accelerations.empty();
  system.exchange().tell_neighbours(
      [&](ByteWriter& writer, int block) {
        writer(state.states[at(block)]);
        if (accelerated) writer(state.accelerations[at(block)]);
      },
      [&](ByteReader& reader, int block) {
        reader(state.states.at(at(block)));
        if (accelerated) reader(state.accelerations[at(block)]);
      });
}

}  // namespace ashlar

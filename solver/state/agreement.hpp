// Decisions of a step that all processes of a run take together, and values that they tell each other. Without other
// processes they are those of this one, and cost nothing.
#pragma once

#include <Eigen/Core>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "solver/byte_archive.hpp"
#include "solver/state/block_system.hpp"
#include "solver/state/step_exchange.hpp"

namespace ashlar {

struct RunState;

/// By place: sum and largest value over all processes, the same on each. Sums are in one order of processes. A value that
/// is no number is infinite in the largest. @param values as many on each process
[[nodiscard]] std::vector<double> sum_of_run(const BlockSystem& system, const std::vector<double>& values);
[[nodiscard]] std::vector<double> most_of_run(const BlockSystem& system, const std::vector<double>& values);

[[nodiscard]] inline double sum_of_run(const BlockSystem& system, double value) {
  return system.exchange().alone() ? value : sum_of_run(system, std::vector{value})[0];
}

[[nodiscard]] inline double most_of_run(const BlockSystem& system, double value) {
  return system.exchange().alone() ? value : most_of_run(system, std::vector{value})[0];
}

[[nodiscard]] inline double least_of_run(const BlockSystem& system, double value) {
  return system.exchange().alone() ? value : -most_of_run(system, -value);
}

[[nodiscard]] inline bool any_of_run(const BlockSystem& system, bool value) {
  return system.exchange().alone() ? value : most_of_run(system, value ? 1.0 : 0.0) > 0.0;
}

/// True if true on all processes.
[[nodiscard]] inline bool all_of_run(const BlockSystem& system, bool value) {
  return !any_of_run(system, !value);
}

/// By place: true if true on any process. @param flags as many on each
[[nodiscard]] std::vector<bool> any_of_run(const BlockSystem& system, const std::vector<bool>& flags);

/// The value of each process, in one order on all.
template <class Value>
[[nodiscard]] std::vector<Value> values_of_run(const BlockSystem& system, const Value& value) {
  if (system.exchange().alone()) return {value};
  ByteWriter writer;
  writer(value);
  const std::string text = writer.take();
  const auto bytes = std::as_bytes(std::span(text));
  std::vector<Value> values;
  for (const std::vector<std::byte>& given : system.exchange().gather({bytes.begin(), bytes.end()})) {
    ByteReader reader({reinterpret_cast<const char*>(given.data()), given.size()});
    reader(values.emplace_back());
  }
  return values;
}

/// The value of the first process that has one.
template <class Value>
[[nodiscard]] std::optional<Value> first_of_run(const BlockSystem& system, std::optional<Value> value) {
  if (system.exchange().alone()) return value;
  for (std::optional<Value>& of_process : values_of_run(system, value))
    if (of_process) return std::move(of_process);
  return std::nullopt;
}

/// Lists of all processes in one, in their order.
template <class Item>
[[nodiscard]] std::vector<Item> joined_of_run(const BlockSystem& system, const std::vector<Item>& items) {
  if (system.exchange().alone()) return items;
  std::vector<Item> all;
  for (std::vector<Item>& of_process : values_of_run(system, items))
    all.insert(all.end(), std::make_move_iterator(of_process.begin()),
               std::make_move_iterator(of_process.end()));
  return all;
}

/// Tells processes the states of their neighbours.
void tell_states(const BlockSystem& system, RunState& state);

/// Sums values over processes, in place.
void sum_of_run(const BlockSystem& system, Eigen::MatrixXd& values);

}  // namespace ashlar

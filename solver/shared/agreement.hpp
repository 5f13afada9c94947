// Decisions of a step that all ranks of a run take together. Without other ranks they are those of this one.
#pragma once

#include <optional>
#include <vector>

#include "solver/ranks/block_share.hpp"
#include "solver/state/block_system.hpp"

namespace ashlar {

[[nodiscard]] inline bool any_of_run(const BlockSystem& system, bool value) {
  return system.share() == nullptr ? value : any_rank(system.share()->ranks(), value);
}

/// True if true on all ranks.
[[nodiscard]] inline bool all_of_run(const BlockSystem& system, bool value) {
  return !any_of_run(system, !value);
}

[[nodiscard]] inline double most_of_run(const BlockSystem& system, double value) {
  return system.share() == nullptr ? value : max_of_ranks(system.share()->ranks(), value);
}

[[nodiscard]] inline double least_of_run(const BlockSystem& system, double value) {
  return system.share() == nullptr ? value : min_of_ranks(system.share()->ranks(), value);
}

[[nodiscard]] inline double sum_of_run(const BlockSystem& system, double value) {
  return system.share() == nullptr ? value : sum_of_ranks(system.share()->ranks(), value);
}

/// By place: true if true on any rank. @param flags as many on each rank
[[nodiscard]] std::vector<bool> any_of_run(const BlockSystem& system, const std::vector<bool>& flags);

/// The value of the lowest rank that has one.
template <class Value>
[[nodiscard]] std::optional<Value> first_of_run(const BlockSystem& system, std::optional<Value> value) {
  if (system.share() == nullptr) return value;
  for (std::optional<Value>& of_rank : values_of_ranks(system.share()->ranks(), value))
    if (of_rank) return std::move(of_rank);
  return std::nullopt;
}

}  // namespace ashlar

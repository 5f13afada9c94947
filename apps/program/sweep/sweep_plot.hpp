// A sweep as a picture: one value against one key, with a line for each combination of the others.
#pragma once

#include <string>
#include <vector>

#include "apps/program/plot/plot.hpp"
#include "apps/program/sweep/sweep_table.hpp"

namespace ashlar {

/// With linear axes. Runs without the value are omitted.
/// @param value a column of the table. The x axis is the first key whose values are all numbers
/// @throws std::invalid_argument with the fault and the requirement: there is no such key, or no such column
[[nodiscard]] Plot sweep_plot(const std::vector<VariedKey>& keys, const SweepTable& table,
                              const std::string& value);

}  // namespace ashlar
